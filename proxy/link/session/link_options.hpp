// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/call_limits.hpp"
#include "proxy/link/session/ring_plan.hpp"
#include "shm/wait/wait_options.hpp"

#include <chrono>
#include <cstddef>
#include <string>

namespace tandem::link {

/// The options of a Link. The two sides need the same name and group; all others may differ.
struct LinkOptions {
    std::string name; ///< of the link; both sides use the same name
    /// Sizes for the data ports. If the two sides ask for different large_bytes, the larger value applies.
    RingSizes rings{};
    /// Minimum shared memory in bytes for each side's objects, without the chunks of its rings.
    std::size_t segment_bytes = std::size_t{4} * 1024 * 1024;
    shm::WaitOptions wait{}; ///< how calls wait, in both directions, and how threads wait on the doorbell
    /// The group of users that may join in addition to the owner (shm::JoinOptions::group); empty: none. A side without a
    /// group that finds a segment with a group, or the reverse, is refused with shm::Error.
    std::string group{};
    std::chrono::nanoseconds worker_idle_time = link::worker_idle_time; ///< shorter in tests
};

} // namespace tandem::link
