// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/call/call_segment.hpp"
#include "shm/call/call_client.hpp"
#include <atomic>

namespace RTC {

/// The calling end of a segment for service calls. [any-thread]
class CallSender {
  public:
    /// Creates a segment. Throws tandem::shm::Error.
    CallSender();

    /// Returns the name for SharedCalls::open(), in the other process.
    const std::string& link() const { return link_; }
    /// Removes the segment's name once the other process has joined. Nothing then remains after the end of both.
    void remove_name();
    /// Executes a call of a stub through shared memory, with the exceptions and within the time limit of a call of the ORB.
    /// Returns false if it has not been executed and must go through the ORB: the other process has ended, executes no more calls
    /// or max_shared_calls already, or the arguments are too long. A call whose time is over counts until it ends.
    bool call(omniCallDescriptor& call);

  private:
    bool is_served();
    bool is_full(std::uint32_t running_before);
    bool read_reply(omniCallDescriptor& call, std::span<const std::byte> bytes);

    const std::string link_;
    CallSegment segment_;
    tandem::shm::CallClient calls_;
    std::atomic<std::uint32_t> running_{0};
    std::atomic<std::uint64_t> checked_at_ns_{0};
    std::atomic<bool> is_over_{false}, has_timed_out_{false};
};

} // namespace RTC
