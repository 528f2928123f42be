// SPDX-License-Identifier: Apache-2.0
// Finds records in a ring without taking them. Internal to the ring: users include ring_reader.hpp.
//
// The writer may be overwriting the bytes that this code reads, or a hostile peer may have written them. So each word is
// read once and checked against this process's own copy of the sizes. An invalid record alone does not prove damage:
// RingConsumer checks whether the tail has moved meanwhile.
#pragma once
#include "shm/ring/ring_view.hpp"

namespace tandem::shm {

enum class ParseResult { nothing, record, invalid };

struct ParsedRecord {
    std::uint64_t start, end; ///< positions of the record itself, after any padding
    CommitWord commit;
};

/// Parses the record at `position`, or the record after the padding there.
template <class A>
ParseResult parse_record(const RingView<A>& ring, std::uint64_t position, ParsedRecord& parsed) {
    std::uint64_t word = A::load(*ring.cell(position), std::memory_order_acquire);
    if (word == 0) return ParseResult::nothing;
    if (CommitWord::unpack(word).kind == layout::RecordKind::padding) {
        position += ring.bytes_to_end(position);
        word = A::load(*ring.cell(position), std::memory_order_acquire);
    }
    const CommitWord commit = CommitWord::unpack(word);
    parsed = {position, position + record_size(commit.length), commit};
    const bool valid = (commit.kind == layout::RecordKind::data && commit.length <= ring.max_record) ||
                       (commit.kind == layout::RecordKind::chunk && commit.length == sizeof(ChunkReference) &&
                        ring.chunk_count != 0);
    return valid && parsed.end - position <= ring.bytes_to_end(position) ? ParseResult::record
                                                                         : ParseResult::invalid;
}

/// Parses the newest record from `tail` on. The shared word `newest` may lag behind by one record for a moment, or forever
/// if the writer was killed between two stores; the loop at the end is for this case. A reader that is up to date never
/// reads this word: it polls only the line where the next record will appear.
template <class A>
ParseResult parse_newest_record(const RingView<A>& ring, std::uint64_t tail, ParsedRecord& parsed) {
    const ParseResult oldest = parse_record(ring, tail, parsed);
    ParsedRecord next;
    ParseResult after =
        oldest == ParseResult::record ? parse_record(ring, parsed.end, next) : ParseResult::nothing;
    if (after == ParseResult::nothing) return oldest;
    const std::uint64_t newest = ring.shared->newest.load(std::memory_order_acquire);
    if (newest > parsed.start && newest - tail < ring.capacity && newest % layout::line == 0) {
        if (parse_record(ring, newest, parsed) != ParseResult::record) return ParseResult::invalid;
        after = parse_record(ring, parsed.end, next);
    }
    constexpr int max_lag = 4;
    for (int i = 0; i < max_lag && after == ParseResult::record; ++i) {
        parsed = next;
        after = parse_record(ring, parsed.end, next);
    }
    return after == ParseResult::invalid ? after : ParseResult::record;
}

/// Parses the oldest of the `depth` newest records from `tail` on, where `parsed` is the oldest of all. The writer's count
/// may also lag behind.
template <class A>
ParseResult parse_within_depth(const RingView<A>& ring, std::uint64_t tail, std::uint64_t depth,
                               ParsedRecord& parsed) {
    const auto published = static_cast<std::uint32_t>(ring.shared->published.load(std::memory_order_relaxed));
    const auto behind = static_cast<std::int32_t>(published - parsed.commit.sequence);
    for (std::int64_t skip = std::int64_t{behind} + 1 - static_cast<std::int64_t>(depth); skip > 0; --skip) {
        ParsedRecord next;
        const ParseResult result = parse_record(ring, parsed.end, next);
        if (result == ParseResult::nothing) break;
        if (result == ParseResult::invalid || next.end - tail > ring.capacity) return ParseResult::invalid;
        parsed = next;
    }
    return ParseResult::record;
}

} // namespace tandem::shm
