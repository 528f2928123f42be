// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/session/ring_plan.hpp"

#include "proxy/wire/type.hpp"
#include "shm/os/error.hpp"
#include "shm/os/shared_copy.hpp"
#include "shm/segment/layout.hpp"
#include "shm/segment/segment_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::link {
namespace {

// Additional bytes that a ring needs for each of its two longest records.
constexpr std::size_t record_overhead = 128;
// One chunk is with the reader, one with the writer, and two wait for the reader.
constexpr std::uint32_t chunks_per_ring = 4;
// Number of ports that may be added while the link is up if their chunks take at most max_late_bytes.
constexpr std::size_t late_ports = 8;
constexpr std::size_t max_late_bytes = std::size_t{1} << 30;

std::size_t effective_large_bytes(const RingSizes& sizes) {
    return sizes.large_bytes != 0 ? sizes.large_bytes : default_large_bytes;
}

} // namespace

std::size_t room_for_late_ports(const RingSizes& sizes) {
    constexpr std::size_t ring_header_bytes = 4096; // including alignment
    const std::size_t each =
        sizes.ring_bytes + ring_header_bytes + chunks_per_ring * effective_large_bytes(sizes);
    return std::min(late_ports * each, max_late_bytes);
}

// Objects begin at multiples of a line pair.
std::size_t object_bytes(std::size_t bytes) { return shm::round_up(bytes, shm::layout::line_pair); }

RingPlan plan_rings(const PortTable& table, shm::Side own, const RingSizes& sizes) {
    RingPlan plan;
    for (const Port& port : table.ports) {
        if (!port.has_ring()) continue;
        shm::RingOptions ring;
        ring.writer = port.kind == PortKind::data_out ? own : shm::other(own);
        ring.capacity = sizes.ring_bytes;
        ring.max_record = sizes.ring_bytes / 2 - record_overhead;
        // The newest data are most valuable to a controller, and a writer must never wait for the other process. A
        // port needs no chunks if its type limits messages to the size of a ring's record.
        const bool may_be_long = wire::max_encoded_bytes(wire::parse_signature(port.signature)) >
                                 static_cast<double>(ring.max_record);
        if (may_be_long && effective_large_bytes(sizes) > ring.max_record) {
            ring.chunk_bytes = effective_large_bytes(sizes);
            ring.chunks = chunks_per_ring;
        }
        const auto memory = shm::ring_memory(port.name, ring);
        plan.chunk_bytes += memory.total - memory.without_chunks;
        plan.object_bytes += object_bytes(memory.without_chunks);
        plan.rings.push_back({&port, ring});
    }
    return plan;
}

void check_available_memory(const RingPlan& plan, const RingSizes& sizes) {
    const std::size_t needed = chunks_per_ring * sizes.large_bytes;
    const auto available = shm::available_bytes();
    if (plan.chunk_bytes == 0 || !available || *available >= needed) return;
    throw shm::Error(
        fmt::format("{}: {} bytes needed for {} messages of large_kib = {}, {} available; enlarge it, "
                    "free some, or lower large_kib",
                    shm::shm_directory, needed, chunks_per_ring, sizes.large_bytes / 1024, *available));
}

} // namespace tandem::link
