// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include "shm/call/call_server.hpp"
#include <functional>
#include <rtm/DataPortStatus.h>
#include <thread>

namespace RTC {

/// The thread of an InPort with listeners that sleeps until it is called to take what is in the ring of its connection.
class MessageServer {
  public:
    /// Receives the messages that are in the ring, and returns the status of the last one; empty: there was none. May throw what a
    /// listener throws; then it is called again for what is left.
    using Receive = std::function<std::optional<DataPortStatus>()>;

    /// `receive` is called in the name of `owner`, which may be NULL. Throws tandem::shm::Error, and std::system_error where the process
    /// gets no further thread.
    MessageServer(MessageRingReader& reader, std::shared_ptr<const ServantOwner> owner, Receive receive);
    /// Refuses all calls from now on. Returns when none is being served, unless one is by the calling thread.
    ~MessageServer();
    MessageServer(const MessageServer&) = delete;
    MessageServer& operator=(const MessageServer&) = delete;

  private:
    struct State;
    const std::shared_ptr<State> state_; // the thread has it, too
    std::thread thread_;
};

} // namespace RTC
