// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include <chrono>
#include <string>

namespace RTC {

/// Sends messages to a receiver in another process. A receiver that hangs does not delay other receivers or the writer
/// for long.
///
/// If the connector is the only one of its port, it sends in the writer's thread, which costs least. After an answer
/// that did not arrive in time, and always if the port has several connectors, a thread of this connector sends queued
/// messages. The writer then waits for the answer only briefly before it serves the other connectors. It never aborts a
/// call in progress, so no message arrives twice or out of order.
///
/// For a receiver on another machine, that thread sends all messages and the writer does not wait at all, because no
/// tick may depend on a network. A message that has waited for sole_answer_timeout is dropped. A receiver that does not
/// answer does not count as lost, because the network may be down. [one writer at a time]
class RemotePush {
  public:
    struct Limits {
        /// How long a writer waits for the answer when this is the only connector of its port.
        std::chrono::milliseconds sole_answer_timeout{2000};
        /// How long a writer waits for the sending thread when the port has other connectors.
        std::chrono::milliseconds shared_answer_timeout{20};
        /// How long the sending thread waits for an answer; after that the receiver counts as lost.
        std::chrono::milliseconds thread_answer_timeout{10000};
        /// The maximum size of the queue. `min_queued_messages` messages may be queued whatever their size.
        std::size_t max_queued_bytes = 1 << 20;
        std::size_t min_queued_messages = 8;
    };

    /// `connection`: its name, for the log.
    RemotePush(std::unique_ptr<RemoteReceiver> receiver, const Limits& limits, std::string connection);
    /// Does not wait: a call in progress ends in the sending thread, which then releases the receiver.
    ~RemotePush();
    RemotePush(const RemotePush&) = delete;
    RemotePush& operator=(const RemotePush&) = delete;

    /// Returns PORT_OK if the receiver has the message or the message is queued, as always for another machine.
    /// SEND_TIMEOUT: there is no answer, and whether the message arrives is unknown. SEND_FULL: the queue is full and
    /// this message was dropped. CONNECTION_LOST: the receiver no longer exists.
    DataPortStatus write(const ByteData& bytes, bool is_sole_connector);
    /// Returns the queued messages that the receiver does not have, or not yet. [any-thread]
    std::uint64_t undelivered() const;

    /// From the connection's properties: `put_timeout` (seconds) is sole_answer_timeout. A receiver that may
    /// hold a message back while its buffer is full (full_policy block) is given that time in addition.
    static Limits limits_from(const coil::Properties& connector_properties);

  private:
    struct SendQueue;
    // Shared with the sending thread, which may still be in a call when this object is destroyed.
    std::shared_ptr<SendQueue> queue_;
};

/// Logs that messages that write() had accepted are lost with their connection; nothing for 0.
void log_lost_with_connection(const std::string& connection, std::uint64_t messages);

} // namespace RTC
