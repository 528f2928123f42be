// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/port_table.hpp"
#include "shm/ring/ring.hpp"

#include <string>
#include <vector>

namespace tandem::link {

/// What a link asks for: of the rings of its data ports, and of messages that are too long for them.
struct RingSizes {
    std::size_t ring_bytes = 256 * 1024;
    /// Longest message of a port whose type sets no bound; it travels in one of four chunks. 0: nobody has
    /// asked for anything, so default_large_bytes, if there is memory for it when it comes.
    std::size_t large_bytes = 0;
};

/// A picture of 1920 x 1080 with 4 bytes per pixel, and its header.
constexpr std::size_t default_large_bytes = std::size_t{8} * 1024 * 1024;
constexpr std::size_t max_large_bytes = std::size_t{1} << 30;

/// The rings that a half lays out for its data ports.
struct RingPlan {
    struct Ring {
        std::string port;
        shm::RingOptions options;
    };
    std::vector<Ring> rings;
    std::size_t chunk_bytes = 0; ///< of their chunks, all together
};
RingPlan plan_rings(const PortTable&, shm::Side own, const RingSizes&);

/// Throws shm::Error when /dev/shm has no room for the chunks of one port, if they were asked for.
void check_available_memory(const RingPlan&, const RingSizes&);

} // namespace tandem::link
