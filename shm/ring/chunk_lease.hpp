// SPDX-License-Identifier: Apache-2.0
// Internal to the ring: users include ring_reader.hpp.
#pragma once
#include "shm/ring/ring_view.hpp"

#include <utility>

namespace tandem::shm {

/// [one thread] The chunk that the reader's last record lies in. It is the reader's until it is given back,
/// by the next read or with the reader itself; moving a lease leaves none behind.
template <class A>
class ChunkLease {
  public:
    ChunkLease() = default;
    ChunkLease(ChunkLease&& from) noexcept
        : returned_(std::exchange(from.returned_, nullptr)), sequence_(from.sequence_) {}
    ChunkLease& operator=(ChunkLease&&) = delete;
    ~ChunkLease() { give_back(); }

    /// `sequence`: of the record that refers to the chunk.
    void take(const RingView<A>& ring, std::uint64_t chunk, std::uint64_t sequence) {
        returned_ = &ring.chunk_words[chunk].returned;
        sequence_ = sequence;
    }

    void give_back() {
        // release: this side's reads of the chunk are done before the writer finds it free
        if (returned_ != nullptr)
            std::exchange(returned_, nullptr)->store(sequence_, std::memory_order_release);
    }

    /// Gives back the chunks of all records before `sequence`, which the reader has skipped. It does not know
    /// which chunks those are, so it marks every chunk: the mark frees only what was lent before.
    static void give_back_skipped(const RingView<A>& ring, std::uint64_t sequence) {
        for (std::uint32_t i = 0; i < ring.chunk_count; ++i)
            ring.chunk_words[i].returned.store(sequence - 1, std::memory_order_release);
    }

  private:
    typename A::template Atomic<std::uint64_t>* returned_ = nullptr;
    std::uint64_t sequence_ = 0;
};

} // namespace tandem::shm
