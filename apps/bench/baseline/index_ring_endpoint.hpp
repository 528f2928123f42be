// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/baseline/index_ring.hpp"
#include "apps/bench/harness/payload.hpp"
#include "apps/bench/harness/session.hpp"

namespace tandem::bench {

template <std::size_t bytes, class Ring>
void write_slot(Ring& ring, std::uint64_t sequence) {
    fill_message(ring.claim(), bytes, sequence);
    ring.publish();
}

/// Returns the slot after its words have been summed.
template <std::size_t bytes, class Ring>
std::uint64_t read_slot(Ring& ring) {
    const std::uint64_t sequence = checked_sequence(ring.wait_for_slot(), bytes);
    ring.release();
    return sequence;
}

/// Two rings, one for each direction. A region is the place of such a pair in the session's memory.
template <std::size_t bytes, Wake wake>
class IndexRingEndpoint {
  public:
    explicit IndexRingEndpoint(Session& session, std::size_t region = 0)
        : out_(memory(session, 2 * region + (session.is_side_a() ? 0 : 1))),
          in_(memory(session, 2 * region + (session.is_side_a() ? 1 : 0))) {}
    void send(std::uint64_t sequence) { write_slot<bytes>(out_, sequence); }
    std::uint64_t receive() { return read_slot<bytes>(in_); }

  private:
    using Ring = IndexRing<bytes, bytes <= 4096 ? 1024 : 4, wake>;
    static std::byte* memory(Session& session, std::size_t index) {
        constexpr std::size_t page = 4096;
        std::byte* const begin =
            session.memory().data() + index * ((Ring::memory_bytes + page) / page * page);
        for (std::size_t offset = 0; offset < Ring::memory_bytes;
             offset += page) // page faults happen now, not in the first lap
            static_cast<void>(*static_cast<volatile std::byte*>(begin + offset));
        return begin;
    }
    Ring out_, in_;
};

} // namespace tandem::bench
