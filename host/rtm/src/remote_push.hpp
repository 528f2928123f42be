// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "remote_data.hpp"
#include <chrono>

namespace RTC {

/// Sends messages to a receiver in another process, in the writer's thread as long as it answers. One that does
/// not answer within a time may hold the writer up once: from then on messages wait, and a thread of their own
/// sends them in order, until the receiver has caught up; only then the writer sends itself again.
/// [one writer at a time]
class RemotePush {
  public:
    struct Bounds {
        std::chrono::milliseconds writer{500};   ///< how long a writer waits for an answer
        std::chrono::milliseconds thread{10000}; ///< how long the thread does, before the receiver is lost
        std::size_t bytes = 1 << 20;             ///< that may wait; 8 messages may in any case
    };
    RemotePush(std::unique_ptr<RemoteReceiver> receiver, const Bounds& bounds);
    ~RemotePush();

    RemotePush(const RemotePush&) = delete;
    RemotePush& operator=(const RemotePush&) = delete;

    /// SEND_TIMEOUT: no answer in time. SEND_FULL: too much is waiting, this message was not taken.
    DataPortStatus write(const ByteData& bytes);
    /// With `writer` as the bound of the connection property put_timeout (seconds).
    static Bounds bounds(const coil::Properties& connector_properties);

  private:
    struct Lane;
    static void run(const std::shared_ptr<Lane>& lane);

    std::shared_ptr<Lane> lane_; // shared with the thread, which may be in a call when this one goes
};

} // namespace RTC
