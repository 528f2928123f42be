// SPDX-License-Identifier: Apache-2.0
// Internal to the ring: users include ring_reader.hpp.
#pragma once
#include "shm/ring/ring_view.hpp"

#include <utility>

namespace tandem::shm {

/// [one thread] The chunk that holds the reader's last record. The reader keeps the chunk until its next read or its
/// destruction. A moved-from lease holds no chunk.
template <class A>
class ChunkLease {
  public:
    ChunkLease() = default;
    ChunkLease(ChunkLease&& from) noexcept
        : returned_(std::exchange(from.returned_, nullptr)), sequence_(from.sequence_) {}
    ChunkLease& operator=(ChunkLease&&) = delete;
    ~ChunkLease() { give_back(); }

    /// Takes the chunk of the record with this sequence.
    void take(const RingView<A>& ring, std::uint64_t chunk, std::uint64_t sequence) {
        returned_ = &ring.chunk_words[chunk].returned;
        sequence_ = sequence;
    }

    void give_back() {
        // release: the writer finds the chunk free only after this side has read it
        if (returned_ != nullptr)
            std::exchange(returned_, nullptr)->store(sequence_, std::memory_order_release);
    }

    /// Gives back the chunks of all records before `sequence`, which the reader has skipped. The reader does not know these
    /// chunks, so it marks every chunk: the mark frees only chunks that were lent before.
    static void give_back_skipped(const RingView<A>& ring, std::uint64_t sequence) {
        for (std::uint32_t i = 0; i < ring.chunk_count; ++i)
            ring.chunk_words[i].returned.store(sequence - 1, std::memory_order_release);
    }

  private:
    typename A::template Atomic<std::uint64_t>* returned_ = nullptr;
    std::uint64_t sequence_ = 0;
};

} // namespace tandem::shm
