// SPDX-License-Identifier: Apache-2.0
// The reading end of a ring: a template over the atomics policy, so that tests can run it in a model. Internal to the ring:
// users include ring_reader.hpp.
//
// While it waits, the reader polls one word: the commit word of the next record. ring_producer.hpp explains the order of
// the writer's stores, and why a copy is whole if the reader could still move the tail.
//
// Everything in the ring is checked against this process's own copy of the sizes before use (record_parser.hpp). Everything
// except the content of a chunk is copied before it is handed out.
#pragma once
#include "shm/ring/chunk_lease.hpp"
#include "shm/ring/reader_backoff.hpp"
#include "shm/ring/record_parser.hpp"

#include <algorithm>
#include <memory>
#include <span>

namespace tandem::shm {

/// A received message; valid until the next read of the same reader, whatever the writer does.
struct Record {
    std::span<const std::byte> bytes; ///< 8-aligned
    std::uint64_t sequence = 0;       ///< 1, 2, 3 ...; a gap means that records were dropped
    std::uint64_t stamp_ns = 0;
    /// payload_front bytes before `bytes` that the user may overwrite; nullptr if the payload is in a chunk
    std::byte* front = nullptr;
};

/// [one thread] Occupies its own cache lines, like RingProducer.
template <class A>
class alignas(layout::line_pair) RingConsumer {
  public:
    explicit RingConsumer(const RingView<A>& ring);
    RingConsumer(RingConsumer&&) noexcept = default;
    RingConsumer& operator=(RingConsumer&&) = delete;

    /// Returns true if there is nothing to read. Loads one line, or two if the first load finds nothing; both stay in this
    /// core's cache until the writer writes there.
    bool empty() const { return load_next(ring_.cell(position_)) == 0 && nothing_new(); }

    /// Returns the oldest record within the depth and skips the records before it. Returns nullptr if there is none, if the
    /// writer overtook each of many attempts, or if the ring is corrupt.
    const Record* read();
    /// Returns the newest record and skips the older ones.
    const Record* read_newest() { return read_slowly(1, load_next(ring_.cell(position_))); }

    /// Limits read() to the newest `records`. No limit if it is 0 or more than the ring holds.
    void set_depth(std::uint64_t records) {
        depth_ = records < ring_.capacity / layout::line ? records : 0;
        ring_.shared->depth.store(depth_, std::memory_order_relaxed);
    }
    std::uint64_t depth() const { return depth_; }

    /// Returns the last record once more, unless it was in a chunk or is longer than max_again bytes.
    const Record* rehearse_read() {
        A::prefetch(ring_.cell(position_));
        __builtin_prefetch(&ring_.shared->received, 1);
        const std::size_t length = record_.bytes.size();
        return length == 0 || length > max_again || record_.front == nullptr ? nullptr : &record_;
    }
    /// Returns the last record once more, whatever its length; nullptr if there is none.
    const Record* again() const { return record_.bytes.data() == nullptr ? nullptr : &record_; }

    bool corrupt() const { return corrupt_; }

  private:
    static std::uint64_t load_next(const typename A::Cell* cells);
    bool nothing_new() const;
    std::uint64_t load_tail() const { return ring_.shared->tail.load(std::memory_order_acquire); }
    const Record* count_or_skip(std::uint64_t bytes);
    const Record* read_slowly(std::uint64_t depth, std::uint64_t word);
    const Record* find_and_take(std::uint64_t depth);
    ParseResult parse(std::uint64_t tail, std::uint64_t depth, ParsedRecord& parsed, bool& is_oldest) const;
    const Record* stop_at(std::uint64_t tail);
    bool copy_payload(const ParsedRecord& parsed);
    std::byte* front() { return reinterpret_cast<std::byte*>(scratch_.get()); }
    std::uint64_t* payload() { return scratch_.get() + payload_front / word_bytes; }
    std::uint64_t full_sequence(const ParsedRecord& parsed, std::uint64_t tail) const;
    bool move_tail(std::uint64_t& from, std::uint64_t to, layout::BasicRingHeader<A>& shared);
    bool take(const ParsedRecord& parsed, std::uint64_t tail, std::uint64_t& skipped);
    const Record* deliver(const ParsedRecord& parsed, std::uint64_t sequence, std::uint64_t skipped);
    const Record* count(std::uint64_t sequence, std::uint64_t bytes, layout::BasicRingHeader<A>& shared);
    void measure_age(std::uint64_t sequence);

    // How often the writer may overtake one read. Each time it has published a whole ring of records during one copy.
    static constexpr int max_attempts = 64;
    // Decoding more bytes than this again takes longer than the cache misses that it saves.
    static constexpr std::size_t max_again = 1024;
    // A value that no commit word without its length has.
    static constexpr std::uint64_t not_expected = 1;
    // Payload bytes in the cache line of the commit word.
    static constexpr std::size_t first_line_payload = layout::line - layout::record_header;

    RingView<A> ring_;
    std::uint64_t position_; // end of the last record; the shared tail may be further
    // The commit word at position_ without its length, if the next record needs nothing but a copy and its age is not
    // measured.
    std::uint64_t expected_ = not_expected;
    bool in_sequence_ = false; // the record at position_ follows record_ in sequence
    bool corrupt_ = false;
    std::uint64_t depth_ = 0; // 0: none
    std::uint64_t received_, bytes_;
    Record record_; // the last record
    mutable ReaderBackoff<A> backoff_;
    ChunkLease<A> lease_;
    // Front and payload of the last record. The kernel provides its pages when they are first written.
    std::unique_ptr<std::uint64_t[]> scratch_;
    std::uint64_t skipped_; // this and the following are rarely needed
    std::uint64_t stamp_ = 0;
    ChunkReference reference_{};
};

template <class A>
RingConsumer<A>::RingConsumer(const RingView<A>& ring)
    : ring_(ring),
      scratch_(std::make_unique_for_overwrite<std::uint64_t[]>(
          (payload_front + std::max(round_up(ring.max_record, 2 * word_bytes), first_line_payload)) /
          word_bytes)) {
    auto& shared = *ring_.shared;
    position_ = shared.tail.load(std::memory_order_acquire);
    received_ = shared.received.load(std::memory_order_relaxed);
    skipped_ = shared.skipped.load(std::memory_order_relaxed);
    bytes_ = shared.bytes_received.load(std::memory_order_relaxed);
    // Only an estimate, because the writer may be dropping records at this moment: in_sequence_ stays false.
    record_.sequence = received_ + skipped_;
    corrupt_ = position_ % layout::line != 0;
}

/// Returns the commit word of the next record, whose cells are given. Also requests the line after it, for records of two
/// lines.
template <class A>
inline std::uint64_t RingConsumer<A>::load_next(const typename A::Cell* cells) {
    A::prefetch(cells + layout::line / word_bytes);
    return A::load(*cells, std::memory_order_acquire);
}

/// The next commit word was 0. If the writer has overtaken this end, that word may be any word of a younger record. Only if
/// the tail has not moved, there is nothing to read.
template <class A>
bool RingConsumer<A>::nothing_new() const {
    backoff_.on_nothing();
    return ring_.shared->tail.load(std::memory_order_relaxed) == position_;
}

/// Handles the usual case in a few instructions: the next record in sequence, in the ring itself. read_slowly() handles all
/// other cases. Constant members are read before the shared words, because the compiler reads them again after those.
template <class A>
inline const Record* RingConsumer<A>::read() {
    const std::uint64_t position = position_, to_end = ring_.bytes_to_end(position);
    const auto* const cells = ring_.cell(position);
    auto& shared = *ring_.shared;
    std::uint64_t* const to = payload();
    const std::uint64_t word = load_next(cells);
    const std::uint64_t length = CommitWord::unpack(word).length, size = record_size(length);
    if ((word & CommitWord::all_but_length) != expected_ || length > ring_.max_record || size > to_end)
        [[unlikely]]
        return read_slowly(depth_, word);
    // Always copies the whole first line, and whole pairs of words. The record has them, scratch_ has room for them, and a
    // copy without a rest is shorter.
    A::copy_atomic_from_shared(to, cells + 2, first_line_payload);
    for (std::size_t word = first_line_payload / word_bytes; word * word_bytes < length; word += 2)
        A::copy_atomic_from_shared(to + word, cells + 2 + word, 2 * word_bytes);
    const std::uint64_t stamp = A::load(*(cells + 1), std::memory_order_acquire);
    std::uint64_t from = position;
    if (!move_tail(from, position + size, shared)) [[unlikely]]
        return read_slowly(depth_, word);
    expected_ += CommitWord::one_sequence;
    // In scratch_ like the last record, otherwise expected_ would be not_expected: see read_slowly().
    record_.bytes = {record_.bytes.data(), length};
    record_.stamp_ns = stamp;
    // Comes after the instruction that waits for all earlier loads, so the load of this line delays nothing. It usually
    // shows that the record is the newest.
    if (depth_ != 0 && A::load(*ring_.cell(position + size), std::memory_order_relaxed) != 0) [[unlikely]]
        return count_or_skip(length);
    return count(record_.sequence + 1, length, shared);
}

/// Handles a record that was just taken off the ring while others wait. If it is not within the depth, the oldest record
/// within the depth takes its place, and deliver() counts the skipped ones.
template <class A>
const Record* RingConsumer<A>::count_or_skip(std::uint64_t bytes) {
    const std::uint64_t sequence = record_.sequence + 1;
    const std::uint64_t published = ring_.shared->published.load(std::memory_order_relaxed);
    if (static_cast<std::int64_t>(published - sequence) < static_cast<std::int64_t>(depth_))
        return count(sequence, bytes, *ring_.shared);
    record_.sequence = sequence;
    ++skipped_;
    return read_slowly(depth_, not_expected);
}

/// `word`: the commit word of the next record.
template <class A>
const Record* RingConsumer<A>::read_slowly(std::uint64_t depth, std::uint64_t word) {
    if (word == 0 && nothing_new()) return nullptr;
    lease_.give_back();
    const Record* const record = find_and_take(depth);
    expected_ = in_sequence_ && record_.front != nullptr && !corrupt_
                    ? CommitWord::pack(layout::RecordKind::data, 0, record_.sequence + 1)
                    : not_expected;
    return record;
}

/// Finds the oldest record of the `depth` newest. `is_oldest`: whether it is the oldest of all.
template <class A>
ParseResult RingConsumer<A>::parse(std::uint64_t tail, std::uint64_t depth, ParsedRecord& parsed,
                                   bool& is_oldest) const {
    ParseResult result = parse_record(ring_, tail, parsed);
    is_oldest = true;
    if (result != ParseResult::record || depth == 0) return result;
    const std::uint64_t oldest = parsed.start;
    result = depth == 1 ? parse_newest_record(ring_, tail, parsed)
                        : parse_within_depth(ring_, tail, depth, parsed);
    is_oldest = parsed.start == oldest;
    return result;
}

template <class A>
const Record* RingConsumer<A>::find_and_take(std::uint64_t depth) {
    for (int attempt = 0; attempt < max_attempts && !corrupt_; ++attempt) {
        const std::uint64_t tail = load_tail();
        corrupt_ = tail % layout::line != 0 || tail < position_;
        if (corrupt_) break;
        ParsedRecord parsed;
        bool is_oldest = false;
        const ParseResult result = parse(tail, depth, parsed, is_oldest);
        if (result == ParseResult::nothing) {
            if (load_tail() == tail) return stop_at(tail);
            continue;
        }
        if (result == ParseResult::invalid || !copy_payload(parsed)) {
            // If the tail has moved, the writer has overtaken this end. If not, the bytes are damaged.
            corrupt_ = load_tail() == tail;
            continue;
        }
        const bool expected_next = in_sequence_ && tail == position_ && is_oldest;
        const std::uint64_t sequence = full_sequence(parsed, tail);
        std::uint64_t skipped = 0;
        if (!take(parsed, tail, skipped)) continue;
        corrupt_ =
            expected_next && sequence != record_.sequence + 1; // no writer numbers its records like that
        if (!corrupt_) return deliver(parsed, sequence, skipped);
    }
    return nullptr;
}

/// Handles an empty place at `tail`. The writer may have moved the tail to this place for a record that is not finished and
/// perhaps never will be. empty() and the next read() must look here.
template <class A>
const Record* RingConsumer<A>::stop_at(std::uint64_t tail) {
    in_sequence_ = in_sequence_ && tail == position_;
    position_ = tail;
    return nullptr;
}

/// Copies the stamp, and the payload or the reference to a chunk. Returns false if the chunk does not belong to this ring.
template <class A>
bool RingConsumer<A>::copy_payload(const ParsedRecord& parsed) {
    const bool in_chunk = parsed.commit.kind == layout::RecordKind::chunk;
    void* to = in_chunk ? static_cast<void*>(&reference_) : payload();
    A::copy_atomic_from_shared(to, ring_.cell(parsed.start + layout::record_header), parsed.commit.length);
    stamp_ = A::load(*ring_.cell(parsed.start + word_bytes), std::memory_order_acquire);
    return !in_chunk || (reference_.chunk < ring_.chunk_count && reference_.bytes <= ring_.chunk_bytes);
}

/// Extends the 32 bits of the commit word to 64: counts on from the last record, or uses the writer's count if the writer
/// has dropped records meanwhile. The writer's count is read before the tail is moved, and the record was in the ring until
/// then, so the difference is at most the number of lines in the ring.
template <class A>
std::uint64_t RingConsumer<A>::full_sequence(const ParsedRecord& parsed, std::uint64_t tail) const {
    if (in_sequence_ && tail == position_)
        return record_.sequence + static_cast<std::uint32_t>(parsed.commit.sequence - record_.sequence);
    const std::uint64_t near = ring_.shared->published.load(std::memory_order_relaxed) + 1;
    return near - static_cast<std::uint32_t>(near - parsed.commit.sequence);
}

/// Takes [from, to) off the ring. Returns false if the writer was faster; `from` is then the tail.
template <class A>
inline bool RingConsumer<A>::move_tail(std::uint64_t& from, std::uint64_t to,
                                       layout::BasicRingHeader<A>& shared) {
    if (!shared.tail.compare_exchange_strong(from, to, std::memory_order_acq_rel, std::memory_order_acquire))
        return false;
    position_ = to;
    return true;
}

/// Moves the tail from its current position to the end of `parsed`. The copy made before is whole if the tail has not
/// passed the record's start. The commit word at the tail contains the oldest sequence number, from which follows the
/// number of skipped records (padding has the number of the record after it).
template <class A>
bool RingConsumer<A>::take(const ParsedRecord& parsed, std::uint64_t tail, std::uint64_t& skipped) {
    for (int attempt = 0; attempt < max_attempts && tail <= parsed.start; ++attempt) {
        const auto oldest = CommitWord::unpack(A::load(*ring_.cell(tail), std::memory_order_acquire));
        skipped = parsed.commit.sequence - oldest.sequence;
        if (move_tail(tail, parsed.end, *ring_.shared)) return true;
    }
    return false;
}

template <class A>
const Record* RingConsumer<A>::deliver(const ParsedRecord& parsed, std::uint64_t sequence,
                                       std::uint64_t skipped) {
    const bool in_chunk = parsed.commit.kind == layout::RecordKind::chunk;
    if (skipped != 0) ChunkLease<A>::give_back_skipped(ring_, sequence);
    if (in_chunk) lease_.take(ring_, reference_.chunk, sequence);
    const std::byte* bytes =
        in_chunk ? ring_.chunk(static_cast<std::uint32_t>(reference_.chunk)) : front() + payload_front;
    const std::size_t length = in_chunk ? reference_.bytes : parsed.commit.length;
    skipped_ += skipped;
    ring_.shared->skipped.store(skipped_, std::memory_order_relaxed);
    in_sequence_ = true; // already true wherever expected_ is a commit word
    record_ = {{bytes, length}, sequence, stamp_, in_chunk ? nullptr : front()};
    if (parsed.commit.sampled) measure_age(sequence);
    return count(sequence, length, *ring_.shared);
}

/// Counts a record that was taken.
template <class A>
inline const Record* RingConsumer<A>::count(std::uint64_t sequence, std::uint64_t bytes,
                                            layout::BasicRingHeader<A>& shared) {
    backoff_.on_record();
    record_.sequence = sequence;
    shared.received.store(++received_, std::memory_order_relaxed);
    shared.bytes_received.store(bytes_ += bytes, std::memory_order_relaxed);
    return &record_;
}

template <class A>
void RingConsumer<A>::measure_age(std::uint64_t sequence) {
    const std::uint64_t sample = ring_.shared->sample.load(std::memory_order_relaxed);
    if (AgeSample::belongs_to(sample, sequence)) ring_.shared->age.add(AgeSample::age(sample, A::now()));
}

} // namespace tandem::shm
