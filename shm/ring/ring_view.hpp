// SPDX-License-Identifier: Apache-2.0
// What both ends of a ring go by. Inside of the ring: users include ring.hpp.
#pragma once
#include "shm/segment/layout.hpp"

namespace tandem::shm {

/// What happens when the reader is slower than the writer.
/// latest_only: the reader gets the newest, everything older is dropped. drop_oldest: the oldest make room.
/// reject: the new one is dropped. wait: the writer waits up to RingOptions::wait, then the new one is
/// dropped.
enum class RingPolicy : std::uint32_t { latest_only, drop_oldest, reject, wait };

/// A ring's memory, and this process's own copy of its sizes.
template <class A>
struct RingView {
    layout::BasicRingHeader<A>* shared = nullptr;
    typename A::Cell* cells = nullptr;
    std::uint64_t capacity = 0, max_record = 0;
    RingPolicy policy = RingPolicy::drop_oldest;
    std::uint32_t chunk_count = 0;
    std::uint64_t chunk_bytes = 0, wait_ns = 0; // from here on rarely needed
    layout::BasicChunkWords<A>* chunk_words = nullptr;
    std::byte* chunks = nullptr;
    // A payload up to this is made elsewhere and copied in at one go: written piece by piece to the line that
    // the reader looks at, it would cost a transfer of that line for every look.
    std::size_t longest_burst = 4096;
    // In a sparse segment: gives memory to the first bytes of a chunk, or says that there is none left.
    bool (*back)(const RingView&, std::uint32_t chunk, std::uint64_t bytes) = nullptr;
    int file = -1;
    std::uint64_t chunks_in_file = 0;

    bool lossy() const { return policy == RingPolicy::latest_only || policy == RingPolicy::drop_oldest; }
    typename A::Cell* cell(std::uint64_t position) const {
        return cells + (position & (capacity - 1)) / word_bytes;
    }
    std::uint64_t to_end(std::uint64_t position) const { return capacity - (position & (capacity - 1)); }
    std::byte* chunk(std::uint32_t index) const { return chunks + index * chunk_bytes; }
};

constexpr std::uint64_t record_bytes(std::uint64_t payload) {
    return (layout::record_header + payload + layout::line - 1) & ~std::uint64_t{layout::line - 1};
}

constexpr std::uint64_t longest_record = (std::uint64_t{1} << 29); ///< the length has 30 bits

/// A record's commit word, taken apart.
struct Commit {
    layout::RecordKind kind;
    std::uint32_t length;
    std::uint8_t tag;
    std::uint32_t sequence; // low 24 bits

    static constexpr std::uint64_t kind_and_sequence = layout::sequence_mask << 40U | std::uint64_t{3} << 30U;
    static constexpr std::uint64_t word(layout::RecordKind kind, std::uint64_t length, std::uint8_t tag,
                                        std::uint64_t sequence) {
        return sequence << 40U | std::uint64_t{tag} << 32U | static_cast<std::uint64_t>(kind) << 30U | length;
    }
    static constexpr Commit of(std::uint64_t word) {
        return {static_cast<layout::RecordKind>(word >> 30U & 3U),
                static_cast<std::uint32_t>(word & 0x3fffffffU), static_cast<std::uint8_t>(word >> 32U),
                static_cast<std::uint32_t>(word >> 40U)};
    }
};

/// The time of publication of every 64th record, packed with the number of that sixty-fourth.
struct Sample {
    static constexpr std::uint64_t every = 64;
    static constexpr std::uint64_t word(std::uint64_t sequence, std::uint64_t ns) {
        return ns >> 4U << 16U | (sequence / every & 0xffffU);
    }
    /// Age in ns of record `sequence` now, if `word` is about it.
    static constexpr bool is_of(std::uint64_t word, std::uint64_t sequence) {
        return (word & 0xffffU) == (sequence / every & 0xffffU);
    }
    static constexpr std::uint64_t age(std::uint64_t word, std::uint64_t ns) {
        return ((ns >> 4U) - (word >> 16U)) << 16U >> 12U;
    }
};

/// What the record of a loan holds.
struct LoanRecord {
    std::uint64_t chunk, bytes;
};

} // namespace tandem::shm
