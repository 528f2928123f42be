// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "shm/ring/ring.hpp"

#include <string>
#include <vector>

namespace tandem::link {

/// The sizes that the user requests with `ring_kib` and `large_kib`.
struct RingSizes {
    std::size_t ring_bytes = std::size_t{256} * 1024; ///< of each data port's ring
    /// The longest message of a port whose type sets no limit. Such a message uses one of four chunks. 0: not
    /// requested; then default_large_bytes applies, and no memory for it is required in advance.
    std::size_t large_bytes = 0;
};

/// Holds an image of 1920 x 1080 with 4 bytes per pixel, and its header.
constexpr std::size_t default_large_bytes = std::size_t{8} * 1024 * 1024;
constexpr std::size_t max_large_bytes = std::size_t{1} << 30;

/// The rings that a side creates in the segment: one for each data port in its table.
struct RingPlan {
    struct Ring {
        const Port* port = nullptr; ///< in the table
        shm::RingOptions options;
    };
    std::vector<Ring> rings;
    std::size_t chunk_bytes = 0;  ///< shared memory of all chunks if all are used
    std::size_t object_bytes = 0; ///< additional memory of the rings
};
/// Returns the number of bytes that a sparse segment reserves for ports added while the link is up. They take no
/// memory until they are used.
std::size_t room_for_late_ports(const RingSizes&);
/// Returns the memory that an object of this size takes in a segment, including alignment.
std::size_t object_bytes(std::size_t bytes);

/// Computes the rings of the ports of side `own`. Throws wire::SignatureError if a port's signature does not parse,
/// shm::Error if a size is not valid for a ring.
RingPlan plan_rings(const PortTable&, shm::Side own, const RingSizes&);

/// Throws shm::Error with both numbers if the user requested long messages and /dev/shm lacks the memory for the
/// chunks of even one port.
void check_available_memory(const RingPlan&, const RingSizes&);

} // namespace tandem::link
