// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include <chrono>

namespace RTC {

/// Sends messages to a receiver in another process, such that a receiver that hangs delays nobody for long.
///
/// The only connector of its port sends in the writer's thread, which costs least. After an answer that did
/// not come in time, and always when the port has several connectors, messages are queued and sent by a
/// thread of this connector; the writer waits for the answer only briefly, then serves the other connectors.
/// A call under way is never broken off for that, so that no message arrives twice or out of order.
///
/// To a receiver on another machine that thread sends everything and the writer does not wait at all, since no tick may
/// depend on a network. A message that has waited for sole_answer_timeout is dropped, and a receiver that does not answer
/// is not lost: the network may be down. [one writer at a time]
class RemotePush {
  public:
    struct Limits {
        /// How long a writer waits for the answer when this is the only connector of its port.
        std::chrono::milliseconds sole_answer_timeout{2000};
        /// How long a writer waits for the sending thread when the port has other connectors.
        std::chrono::milliseconds shared_answer_timeout{20};
        /// How long the sending thread waits for an answer; after that the receiver counts as lost.
        std::chrono::milliseconds thread_answer_timeout{10000};
        /// How much may be queued; `min_queued_messages` may be queued whatever their size.
        std::size_t max_queued_bytes = 1 << 20;
        std::size_t min_queued_messages = 8;
    };

    RemotePush(std::unique_ptr<RemoteReceiver> receiver, const Limits& limits);
    /// Does not wait: a call under way ends in the sending thread, which then lets go of the receiver.
    ~RemotePush();
    RemotePush(const RemotePush&) = delete;
    RemotePush& operator=(const RemotePush&) = delete;

    /// PORT_OK: the receiver has the message, or it is queued, as always for another machine. SEND_TIMEOUT: no answer; whether the message
    /// arrives is unknown. SEND_FULL: the queue is full and this message was dropped. CONNECTION_LOST: the
    /// receiver is gone.
    DataPortStatus write(const ByteData& bytes, bool is_sole_connector);
    /// Messages that were queued and that the receiver does not have, or not yet. [any-thread]
    std::uint64_t undelivered() const;

    /// From the connection's properties: `put_timeout` (seconds) is sole_answer_timeout. A receiver that may
    /// hold a message back while its buffer is full (full_policy block) is given that time in addition.
    static Limits limits_from(const coil::Properties& connector_properties);

  private:
    struct SendQueue;
    // Shared with the sending thread, which may still be in a call when this object is destroyed.
    std::shared_ptr<SendQueue> queue_;
};

} // namespace RTC
