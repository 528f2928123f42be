// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "shm/ring/ring.hpp"

#include <string>
#include <vector>

namespace tandem::link {

/// The sizes that the user asked for, with `ring_kib` and `large_kib`.
struct RingSizes {
    std::size_t ring_bytes = std::size_t{256} * 1024; ///< of each data port's ring
    /// The longest message of a port whose type sets no bound; it travels in one of four chunks. 0: the user
    /// did not ask. Then it is default_large_bytes, and no memory for it is required in advance.
    std::size_t large_bytes = 0;
};

/// An image of 1920 x 1080 with 4 bytes per pixel, and its header.
constexpr std::size_t default_large_bytes = std::size_t{8} * 1024 * 1024;
constexpr std::size_t max_large_bytes = std::size_t{1} << 30;

/// The rings that a side creates in the segment, one for each data port in its table.
struct RingPlan {
    struct Ring {
        const Port* port = nullptr; ///< in the table
        shm::RingOptions options;
    };
    std::vector<Ring> rings;
    std::size_t chunk_bytes = 0;  ///< shared memory that the chunks of all rings take when all are used
    std::size_t object_bytes = 0; ///< what the rings take beside that
};
/// Shared memory that is left for ports that are added when the link is up, in bytes of a sparse segment: it takes none until
/// it is used.
std::size_t room_for_late_ports(const RingSizes&);
/// The memory that an object of that size takes in a segment, with what is lost to alignment.
std::size_t object_bytes(std::size_t bytes);

/// Computes the rings of the ports that side `own` has. Throws wire::SignatureError if a port's signature does
/// not parse, shm::Error if a size is not acceptable for a ring.
RingPlan plan_rings(const PortTable&, shm::Side own, const RingSizes&);

/// Throws shm::Error, with both numbers, if the user asked for long messages and /dev/shm has not even the
/// memory for the chunks of one port.
void check_available_memory(const RingPlan&, const RingSizes&);

} // namespace tandem::link
