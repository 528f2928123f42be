// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/session/ring_plan.hpp"
#include "shm/wait/wait_options.hpp"

#include <cstddef>
#include <string>

namespace tandem::link {

/// What the owner of a Link chooses. The two sides need the same name and group, and nothing else in common.
struct LinkOptions {
    std::string name;  ///< of the link; both sides use the same
    RingSizes rings{}; ///< of the data ports; where the two sides ask for different large_bytes, the larger
    /// At least this much shared memory for each side's objects, without the chunks of its rings.
    std::size_t segment_bytes = std::size_t{4} * 1024 * 1024;
    shm::WaitOptions wait{}; ///< how calls wait, in both directions, and how the doorbell is waited for
    /// Users that may join beside the owner (shm::JoinOptions::group); empty: none. A side that finds a segment
    /// made for one group by a side that names none, or the reverse, is refused with shm::Error.
    std::string group{};
};

} // namespace tandem::link
