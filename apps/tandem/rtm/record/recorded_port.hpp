// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/stream/untyped_ports.hpp"
#include "proxy/wire/type.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

/// A received message, not decoded.
struct ReceivedSample {
    std::size_t port = 0;      ///< index among the recorded ports
    std::uint64_t time_ns = 0; ///< of its arrival, CLOCK_MONOTONIC
    RTC::ByteData bytes;
};

/// Messages of all recorded ports, in order of reception. ORB threads add them, the main thread takes them.
/// [any-thread]
class ReceivedSamples {
  public:
    static constexpr std::size_t max_bytes = 64 << 20; ///< limit for waiting messages; others are dropped

    /// Returns false if there is no room.
    bool add(std::size_t port, std::uint64_t time_ns, const RTC::ByteData& bytes);
    /// Removes and returns all waiting messages. If there are none, waits up to `timeout` for the first one.
    std::vector<ReceivedSample> take(std::chrono::milliseconds timeout);

  private:
    std::mutex mutex_;
    std::condition_variable received_;
    std::vector<ReceivedSample> samples_;
    std::size_t bytes_ = 0;
};

/// A recorded OutPort and this program's InPort that is connected to it. [main-thread]
class RecordedPort {
  public:
    /// `samples` must outlive this object. `message`: the port's type. Throws std::runtime_error if the connection
    /// fails.
    RecordedPort(RemotePort remote, const wire::Type& message, std::size_t number, ReceivedSamples& samples,
                 const std::vector<std::string>& properties);
    ~RecordedPort();

    const RemotePort& remote() const { return remote_; }
    const wire::Type& message() const { return message_; }
    std::uint64_t dropped() const; ///< because this program had no room
    std::uint64_t received() const;
    /// Asks the sender's host and returns the number of messages that the sender's buffer lost before sending, by all
    /// connections so far; nullopt if the host does not count.
    std::optional<std::uint64_t> lost_by_sender();
    /// Reconnects if the other port has dropped the connection. OpenRTM-aist's ports do so silently after one failed
    /// call. Returns true if it reconnected.
    bool restore();

  private:
    class Listener;
    class Port;
    void connect();

    RemotePort remote_;
    const wire::Type message_;
    const std::vector<std::string> properties_;
    std::unique_ptr<Port> port_;
    std::unique_ptr<PortConnection> connection_; ///< must end before the port
    std::uint64_t lost_before_ = 0;              ///< by earlier connections
    std::uint64_t lost_ = 0;                     ///< as last returned
};

} // namespace tandem::command
