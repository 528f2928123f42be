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

/// A message as it came.
struct ReceivedSample {
    std::size_t port = 0; ///< its number among the recorded ports
    std::uint64_t time_ns = 0;
    RTC::ByteData bytes;
};

/// What all recorded ports have received, in that order. Filled by threads of the ORB, emptied by the main thread. [any-thread]
class ReceivedSamples {
  public:
    static constexpr std::size_t max_bytes = 64 << 20; ///< that wait; messages beyond them are dropped

    /// Returns false if there was no room.
    bool add(std::size_t port, std::uint64_t time_ns, const RTC::ByteData& bytes);
    /// Waits for the first, at most so long.
    std::vector<ReceivedSample> take(std::chrono::milliseconds timeout);

  private:
    std::mutex mutex_;
    std::condition_variable received_;
    std::vector<ReceivedSample> samples_;
    std::size_t bytes_ = 0;
};

/// An OutPort that is recorded, and the InPort of this program that is connected with it. [main-thread]
class RecordedPort {
  public:
    /// `samples` must outlive this object. `message`: the port's type. Throws std::runtime_error if the ports cannot be connected.
    RecordedPort(RemotePort remote, const wire::Type& message, std::size_t number, ReceivedSamples& samples,
                 const std::vector<std::string>& properties);
    ~RecordedPort();

    const RemotePort& remote() const { return remote_; }
    const wire::Type& message() const { return message_; }
    std::uint64_t dropped() const; ///< for lack of room here
    std::uint64_t received() const;
    /// Messages that its sender's buffer did not hold until they were sent, if the sender's host counts them.
    std::optional<std::uint64_t> lost_by_sender() const;
    /// Connects again if the other port has dropped the connection. OpenRTM-aist's ports do so silently after one
    /// failed call. Returns true if that was necessary.
    bool restore();

  private:
    class Listener;
    class Port;
    void connect();

    RemotePort remote_;
    const wire::Type message_;
    const std::vector<std::string> properties_;
    std::unique_ptr<Port> port_;
    std::unique_ptr<PortConnection> connection_; ///< ends before the port does
    std::uint64_t lost_before_ = 0;              ///< on earlier connections
};

} // namespace tandem::command
