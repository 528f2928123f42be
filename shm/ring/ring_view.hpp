// SPDX-License-Identifier: Apache-2.0
// What the writing and the reading end of a ring share: its place, its sizes, and the first words of records. Internal to
// the ring: users include ring_writer.hpp and ring_reader.hpp.
#pragma once
#include "shm/segment/layout.hpp"

namespace tandem::shm {

/// The place of a ring, and this process's own, checked copy of its sizes. The sizes in shared memory are not read again,
/// because the peer may change them.
template <class A>
struct RingView {
    layout::BasicRingHeader<A>* shared = nullptr;
    typename A::Cell* cells = nullptr;
    std::uint64_t capacity = 0, max_record = 0;
    std::uint32_t chunk_count = 0;
    std::uint64_t chunk_bytes = 0;
    layout::BasicChunkWords<A>* chunk_words = nullptr;
    std::byte* chunks = nullptr;
    // In a sparse segment: allocates memory for the first `bytes` of a chunk. Returns false if /dev/shm is full.
    bool (*allocate_chunk)(const RingView&, std::uint32_t chunk, std::uint64_t bytes) = nullptr;
    int file = -1;
    std::uint64_t chunks_in_file = 0; ///< offset of the first chunk in the segment's file

    typename A::Cell* cell(std::uint64_t position) const {
        return cells + (position & (capacity - 1)) / word_bytes;
    }
    std::uint64_t bytes_to_end(std::uint64_t position) const {
        return capacity - (position & (capacity - 1));
    }
    std::byte* chunk(std::uint32_t index) const { return chunks + index * chunk_bytes; }
};

/// Adds 1 to a counter that no other thread writes.
inline void count_one(layout::Word64& counter) {
    counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

/// Returns the number of bytes that a record with this payload takes in the ring: whole cache lines.
constexpr std::uint64_t record_size(std::uint64_t payload_bytes) {
    return (layout::record_header + payload_bytes + layout::line - 1) & ~std::uint64_t{layout::line - 1};
}

/// Bytes of private memory before a payload that is not in a chunk, for data that its user puts in front.
constexpr std::size_t payload_front = word_bytes;

constexpr std::uint64_t max_payload_in_ring = std::uint64_t{1} << 28; ///< the length field has 29 bits

/// The first word of a record, unpacked. layout.hpp defines the format.
struct CommitWord {
    layout::RecordKind kind;
    std::uint32_t length;
    std::uint32_t sequence; ///< low 32 bits of the record's sequence number
    bool sampled;           ///< its publication time is in the header

    static constexpr std::uint64_t sampled_bit = std::uint64_t{1} << 29;
    static constexpr std::uint64_t all_but_length = ~(sampled_bit - 1);
    static constexpr std::uint64_t one_sequence = std::uint64_t{1} << 32;
    static constexpr std::uint64_t pack(layout::RecordKind kind, std::uint64_t length,
                                        std::uint64_t sequence) {
        return sequence << 32U | static_cast<std::uint64_t>(kind) << 30U | length;
    }
    static constexpr CommitWord unpack(std::uint64_t word) {
        return {static_cast<layout::RecordKind>(word >> 30U & 3U),
                static_cast<std::uint32_t>(word & ~all_but_length), static_cast<std::uint32_t>(word >> 32U),
                (word & sampled_bit) != 0};
    }
};

/// The publication time of a sampled record, in one word with the low bits of its number, so that the reader cannot take
/// the time of one record for that of another. Sampled are the first record, every 64th, and about one per 0.2 s where
/// rehearsals or sleeping readers show that there is time: nearly every record of a slow port, and every twentieth of a port
/// that sends every 10 ms, so that neither its median nor its p90 shows the cost of sampling.
struct AgeSample {
    static constexpr std::uint64_t interval = 64; ///< largest distance of two samples, records
    static constexpr std::uint64_t longest_pause_ns =
        200'000'000; ///< largest distance of two samples, where it is known without a clock
    static constexpr std::uint64_t pack(std::uint64_t sequence, std::uint64_t ns) {
        return ns >> 4U << 16U | (sequence & 0xffffU);
    }
    static constexpr bool belongs_to(std::uint64_t word, std::uint64_t sequence) {
        return (word & 0xffffU) == (sequence & 0xffffU);
    }
    /// Returns the nanoseconds from the publication to `ns`. The 48 bits of time wrap around after 52 days.
    static constexpr std::uint64_t age(std::uint64_t word, std::uint64_t ns) {
        return ((ns >> 4U) - (word >> 16U)) << 16U >> 12U;
    }
};

/// The payload of a record whose message is in a chunk.
struct ChunkReference {
    std::uint64_t chunk, bytes;
};

} // namespace tandem::shm
