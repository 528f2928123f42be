// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include "shm/call/call_server.hpp"
#include <functional>
#include <rtm/DataPortStatus.h>
#include <thread>

namespace RTC {

/// The thread of an InPort with listeners. It sleeps until it is called to receive the messages in the ring of its
/// connection.
class MessageServer {
  public:
    /// Receives the messages in the ring and returns the status of the last one; empty if there was none. May throw
    /// exceptions of listeners, and is then called again for the remaining messages.
    using Receive = std::function<std::optional<DataPortStatus>()>;

    /// Calls `receive` on behalf of `owner`, which may be NULL. Throws tandem::shm::Error, and std::system_error if the
    /// process cannot create another thread.
    MessageServer(MessageRingReader& reader, std::shared_ptr<const ServantOwner> owner, Receive receive);
    /// Refuses all calls from now on. Returns when no call is being served, except one by the calling thread.
    ~MessageServer();
    MessageServer(const MessageServer&) = delete;
    MessageServer& operator=(const MessageServer&) = delete;

  private:
    struct State;
    const std::shared_ptr<State> state_; // the thread keeps a reference, too
    std::thread thread_;
};

} // namespace RTC
