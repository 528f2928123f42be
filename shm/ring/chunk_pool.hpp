// SPDX-License-Identifier: Apache-2.0
// Internal to the ring: users include ring_writer.hpp.
#pragma once
#include "shm/ring/ring_view.hpp"

#include <algorithm>
#include <vector>

namespace tandem::shm {

/// [one thread] The chunks of a ring as its writer sees them: which chunks are lent to a record, and which have memory.
template <class A>
class ChunkPool {
  public:
    explicit ChunkPool(const RingView<A>& ring)
        : lent_to_(ring.chunk_count), allocated_(ring.allocate_chunk != nullptr ? ring.chunk_count : 0) {}

    /// Call it before the attempts for one message: they ask the system for memory only once.
    void begin_message() { no_memory_ = false; }

    /// Makes a free chunk with memory for `bytes` current. Returns false if there is none. Goes round robin from the last
    /// chunk: a chunk is then reused late, when its lines have left the reader's cache and need no transfer.
    bool find_free(const RingView<A>& ring, std::uint64_t bytes) {
        for (std::uint32_t i = 1; i <= ring.chunk_count; ++i) {
            const std::uint32_t index = (current_ + i) % ring.chunk_count;
            if (!is_free(ring, index) || !allocate(ring, index, bytes)) continue;
            lent_to_[index] = 0;
            current_ = index;
            return true;
        }
        return false;
    }

    /// Returns whether the next find_free() succeeds. Gives the chunk memory if necessary.
    bool has_free(const RingView<A>& ring, std::uint64_t bytes) {
        begin_message();
        for (std::uint32_t index = 0; index < ring.chunk_count; ++index)
            if (is_free(ring, index) && allocate(ring, index, bytes)) return true;
        return false;
    }

    std::uint32_t current() const { return current_; } ///< the index that find_free() chose

    /// Lends the current chunk to the record with this sequence.
    void lend(std::uint64_t sequence) { lent_to_[current_] = sequence; }

    /// Frees the chunk of the record with this sequence, which was dropped before the reader took it.
    void take_back(std::uint32_t sequence) {
        for (auto& lent_to : lent_to_)
            if (static_cast<std::uint32_t>(lent_to) == sequence) lent_to = 0;
    }

  private:
    bool is_free(const RingView<A>& ring, std::uint32_t index) const {
        // acquire: the reader has finished with the chunk before this end writes to it
        return lent_to_[index] == 0 ||
               ring.chunk_words[index].returned.load(std::memory_order_acquire) >= lent_to_[index];
    }

    /// Gives a chunk of a sparse segment memory at its first use. Returns false if no memory is left; another chunk may
    /// have enough already.
    bool allocate(const RingView<A>& ring, std::uint32_t index, std::uint64_t bytes) {
        if (ring.allocate_chunk == nullptr || bytes <= allocated_[index]) return true;
        // Allocates in steps of 1 MiB, so that a series of growing messages does not make a system call for each message.
        constexpr std::uint64_t step = std::uint64_t{1} << 20;
        for (const std::uint64_t unit : {step, std::uint64_t{layout::page}}) {
            const std::uint64_t wanted = std::min(round_up(bytes, unit), ring.chunk_bytes);
            if (no_memory_ || !ring.allocate_chunk(ring, index, wanted)) continue;
            allocated_[index] = wanted;
            return true;
        }
        no_memory_ = true;
        return false;
    }

    std::uint32_t current_ = 0;
    std::vector<std::uint64_t> lent_to_;   // per chunk: sequence of the record that refers to it, 0 = none
    std::vector<std::uint64_t> allocated_; // per chunk: bytes that have memory, in a sparse segment
    bool no_memory_ = false;
};

} // namespace tandem::shm
