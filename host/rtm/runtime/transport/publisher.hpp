// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/buffer/port_buffer.hpp"
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <rtm/ConnectorBase.h>
#include <string>
#include <thread>

namespace RTC {

/// A thread that delivers messages in the place of the writer (subscription types new and periodic), so that
/// a slow receiver does not hold the writer up. Properties, as in OpenRTM-aist, with or without `publisher.`:
/// `push_policy` all | fifo | skip | new (default new), `skip_count`, `push_rate` (Hz, periodic); `buffer.*`.
/// Policies for waiting messages: `all` delivers all of them, `fifo` (periodic) the oldest, `skip` every (skip_count + 1)th,
/// `new` the newest.
class Publisher {
  public:
    /// Delivers one message. The publisher's thread calls it, but never again after it has returned CONNECTION_LOST.
    using Deliver = std::function<DataPortStatus(ByteData&)>;

    /// NULL for the subscription type flush, which delivers in the writer's thread. `connection`: its name, for the log.
    static std::unique_ptr<Publisher> create(const coil::Properties& properties,
                                             const std::string& connection, Deliver deliver);
    /// Returns whether a publisher with these properties delivers only the newest message.
    static bool delivers_newest_only(const coil::Properties& properties);
    /// Starts the thread.
    Publisher(const coil::Properties& properties, std::string connection, bool periodic, Deliver deliver);
    /// Waits for the current delivery. Messages that are still waiting are dropped.
    ~Publisher();
    /// [writer's thread] Queues one message. Returns CONNECTION_LOST once a delivery has returned it. Sets `overwritten`
    /// to whether a waiting message was dropped to make room.
    DataPortStatus write(const ByteData& bytes, bool& overwritten);
    CdrBufferBase& buffer() { return buffer_; }
    /// Returns the number of messages that the buffer did not accept, or did not keep until their turn. Never too high while
    /// messages are in progress. [any-thread]
    std::uint64_t lost() const;

  private:
    enum class Policy { all, fifo, skip, newest };
    static Policy policy_of(const coil::Properties& properties);
    void run();
    void deliver_readable();

    const std::string connection_;
    Deliver deliver_;
    PortBuffer buffer_; // the writer and the thread do not wait for each other in it
    Policy policy_ = Policy::newest;
    unsigned skip_count_ = 0;
    unsigned skip_position_ = 0;         // counts messages under the policy skip
    std::chrono::nanoseconds period_{0}; // 0: deliver at each write
    std::mutex mutex_;                   // guards written_ and stopping_
    std::condition_variable wake_;
    bool written_ = false; // since the thread looked last
    bool stopping_ = false;
    std::atomic<bool> connection_lost_{false};
    std::atomic<std::uint64_t> writes_{0}, taken_{0}; // of the buffer
    std::thread thread_;                              // last member: run() uses all others
};

} // namespace RTC
