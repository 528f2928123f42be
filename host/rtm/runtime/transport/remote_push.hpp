// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include <chrono>

namespace RTC {

/// Sends messages to a receiver in another process, such that one that hangs holds nobody up for long.
/// The only connector of its port sends in the writer's thread, which costs least; when an answer is missing
/// after a time, messages go by a thread of this connector until the receiver has caught up. Where a port has
/// several connectors they always do: the writer waits for the answer only a moment, then the others are
/// next. No call is broken off for that, so nothing arrives twice or in another order. [one writer at a time]
class RemotePush {
  public:
    struct Limits {
        std::chrono::milliseconds sole_answer_timeout{
            2000};                            ///< a writer's wait for an answer, as the only connector
        std::chrono::milliseconds beside{20}; ///< its wait for the thread, beside other connectors
        std::chrono::milliseconds thread{
            10000};                  ///< the thread's wait for an answer; then the receiver is lost
        std::size_t bytes = 1 << 20; ///< that may wait; 8 messages may in any case
    };
    RemotePush(std::unique_ptr<RemoteReceiver> receiver, const Limits& bounds);
    ~RemotePush();
    RemotePush(const RemotePush&) = delete;
    RemotePush& operator=(const RemotePush&) = delete;

    /// PORT_OK may also mean: will be sent. SEND_TIMEOUT: no answer, nobody knows whether the message
    /// arrives. SEND_FULL: too much is waiting, this message was not taken.
    DataPortStatus write(const ByteData& bytes, bool alone);
    /// From the connection's properties: `put_timeout` (seconds) is the bound `alone`; a receiver that may
    /// hold a message back while its buffer is full is given that time on top.
    static Limits limits_from(const coil::Properties& connector_properties);

  private:
    struct SendQueue;
    static void run(const std::shared_ptr<SendQueue>& queue);

    std::shared_ptr<SendQueue> queue_; // shared with the thread, which may be in a call when this one goes
};

} // namespace RTC
