// SPDX-License-Identifier: Apache-2.0
// The writing end of a ring: a template over the atomics policy, so that tests can run it in a model. Internal to the ring:
// users include ring_writer.hpp.
//
// head belongs to this end; the reader's words are checked before they are used. One publication makes these
// stores in this order, each with release:
//
//     write_limit | 0 where the next record will begin | payload, stamp | commit word (| padding before it) | head | newest
//
// A writer killed before the commit word (of the padding, if there is one, since that is what the reader
// looks at) has published nothing.
//
// When the ring is full the writer takes the oldest records away by moving the tail itself, while the reader
// may be copying them. So the reader counts a copy only if it can still move the tail from where it was (the
// SOFI protocol, after iceoryx's safely overflowing FIFO):
//
//     writer: W1 CAS tail t -> t'  | W2 stores words over [t, t') (release, each)
//     reader: R1 loads tail t      | R2 loads words of [t, t') (acquire, each)    | R3 CAS tail t -> t'
//
//     If any R2 saw a word of W2, that pair synchronizes, W1 happens before R3, and R3 fails (the tail only
//     grows, so it is never t again). If R3 succeeds, no R2 saw W2, and the copy is whole.
//
// Therefore payloads are stored word by word with atomic stores: the user creates them in private memory, and commit()
// copies them. Only the content of a chunk is written in place, because nothing overwrites a chunk while it is lent.
#pragma once
#include "shm/ring/chunk_pool.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tandem::shm {

/// [one thread] Occupies its own cache lines: in one process, a reader in the same line would turn every write into a
/// transfer of that line.
template <class A>
class alignas(layout::line_pair) RingProducer {
  public:
    explicit RingProducer(const RingView<A>& ring);

    /// Where to write a reserved payload. refused: nowhere; the message counts as sent and dropped. scratch: into memory of
    /// the caller, passed to commit(). chunk: into chunk().
    enum class Reservation { refused, scratch, chunk };

    Reservation reserve(std::size_t bytes);
    std::byte* chunk() const { return ring_.chunk(chunks_.current()); }
    bool is_open() const { return reservation_ != Reservation::refused; }
    std::size_t reserved_bytes() const { return reserved_bytes_; }
    void cancel_reservation() { reservation_ = Reservation::refused; }

    /// Publishes the first `used` bytes of the reservation. Returns false if the message is refused and counted after all.
    bool commit(const void* scratch, std::size_t used, std::uint64_t stamp);

    /// Returns whether a message of this length can be published without dropping an older one.
    bool has_room(std::size_t bytes) {
        if (bytes > ring_.max_record)
            return bytes <= ring_.chunk_bytes && chunks_.has_free(ring_, bytes) &&
                   fits(room_for(record_size(sizeof(ChunkReference))));
        return fits(room_for(record_size(bytes)));
    }
    /// Counts a message that its sender could not create as sent and dropped. Returns false.
    bool refuse();

    /// Publishes a message of up to max_record bytes if it fits after the last one, without reserve() and commit().
    /// Returns false and changes nothing if it does not fit, if that is not known yet, or if its age must be measured.
    /// `readable_behind`: up to 48 bytes after `bytes` are readable and may be copied, too.
    bool write_behind_last(const void* bytes, std::size_t count, std::uint64_t stamp, bool readable_behind);
    /// Publishes like write_behind_last(), but a message of one word and `count` bytes at another address.
    bool write_words_behind_last(std::uint64_t first, const void* others, std::size_t count,
                                 std::uint64_t stamp);
    /// Publishes by write_behind_last() or by reserve(), a copy and commit(). Returns false if the message was refused.
    bool write(const void* bytes, std::size_t count, std::uint64_t stamp);
    /// Loads what a message of this length needs into the caches. Also has the next age measured if none was
    /// measured for a long time.
    void prefetch_next(std::size_t bytes);
    /// Makes the producer measure the age of the next message.
    void sample_next() {
        sample_next_ = true;
        room_end_ = 0; // forces the path through commit()
    }

    std::uint64_t sent() const { return sent_; }
    bool corrupt() const { return corrupt_; }
    std::uint64_t max_message() const { return std::max(ring_.max_record, ring_.chunk_bytes); }

  private:
    std::uint64_t padding_before(std::uint64_t record) const {
        return record <= ring_.bytes_to_end(head_) ? 0 : ring_.bytes_to_end(head_);
    }
    std::uint64_t room_for(std::uint64_t record) const {
        return padding_before(record) + record + layout::line; // one line always stays free for the next 0
    }
    bool is_plausible(std::uint64_t tail) const;
    bool fits(std::uint64_t room);
    bool drop_oldest();
    bool drop_until_fits(std::uint64_t room);
    bool fail();
    bool claim_chunk(std::uint64_t bytes);
    static void copy_payload(typename A::Cell* to, const void* payload, std::size_t used,
                             bool readable_behind);
    static constexpr bool is_sampled(std::uint64_t sequence) { return sequence % AgeSample::interval == 0; }
    bool sample_age_of_next();
    void clear_commit_word(std::uint64_t position);
    void prepare_next(std::uint64_t head, std::uint64_t record);
    bool fits_behind_last(std::size_t count) const {
        return head_ + record_size(count) <= room_end_ && !is_sampled(sequence_ + 1);
    }
    template <class Copy>
    void publish(layout::RecordKind kind, std::uint64_t padding, std::size_t used, std::uint64_t stamp,
                 Copy&& copy_to, std::uint64_t flags = 0);

    RingView<A> ring_;
    std::uint64_t head_, tail_; // tail as this end last saw it
    // Up to here, records need neither padding nor a check of the tail. 0: unknown, corrupt, or the next record is sampled.
    std::uint64_t room_end_ = 0;
    std::uint64_t cleared_at_; // the position at which 0 was stored last
    std::uint64_t sequence_;   // of the newest record
    std::uint64_t sent_, refused_, overwritten_, bytes_;
    std::uint64_t sampled_ns_ = 0; // when an age was sampled last
    bool sample_next_ = false;
    Reservation reservation_ = Reservation::refused;
    std::size_t reserved_bytes_ = 0;
    ChunkPool<A> chunks_;
    bool corrupt_ = false;
};

template <class A>
RingProducer<A>::RingProducer(const RingView<A>& ring) : ring_(ring), chunks_(ring) {
    auto& shared = *ring_.shared;
    head_ = cleared_at_ = shared.head.load(std::memory_order_acquire);
    tail_ = 0;
    tail_ = shared.tail.load(std::memory_order_acquire);
    sent_ = shared.sent.load(std::memory_order_relaxed);
    refused_ = shared.refused.load(std::memory_order_relaxed);
    overwritten_ = shared.overwritten.load(std::memory_order_relaxed);
    bytes_ = shared.bytes_sent.load(std::memory_order_relaxed);
    sequence_ = shared.published.load(std::memory_order_relaxed);
    corrupt_ = head_ % layout::line != 0 || !is_plausible(tail_);
}

template <class A>
bool RingProducer<A>::is_plausible(std::uint64_t tail) const {
    return tail >= tail_ && tail <= head_ && head_ - tail <= ring_.capacity && tail % layout::line == 0;
}

/// Marks the ring corrupt. Returns false for the callers to return.
template <class A>
bool RingProducer<A>::fail() {
    corrupt_ = true;
    room_end_ = 0;
    return false;
}

template <class A>
bool RingProducer<A>::fits(std::uint64_t room) {
    // Uses the last known tail if possible, because that does not touch the reader's line.
    if (head_ + room - tail_ <= ring_.capacity) return true;
    const std::uint64_t tail = ring_.shared->tail.load(std::memory_order_acquire);
    if (corrupt_ || !is_plausible(tail)) return fail();
    tail_ = tail;
    return head_ + room - tail_ <= ring_.capacity;
}

/// Drops the record or the padding at the tail, unless the reader is faster. Returns false if the ring is corrupt.
template <class A>
bool RingProducer<A>::drop_oldest() {
    const auto oldest = CommitWord::unpack(A::load(*ring_.cell(tail_), std::memory_order_relaxed));
    const bool padding = oldest.kind == layout::RecordKind::padding;
    const std::uint64_t step = padding ? ring_.bytes_to_end(tail_) : record_size(oldest.length);
    // This end has written every word from tail_ on, even if the reader has moved the tail since.
    if (oldest.kind == layout::RecordKind::none || step > ring_.bytes_to_end(tail_) || step > head_ - tail_)
        return fail();
    std::uint64_t tail = tail_;
    const bool dropped = ring_.shared->tail.compare_exchange_strong(
        tail, tail_ + step, std::memory_order_acq_rel, std::memory_order_acquire);
    if (!dropped) {
        if (!is_plausible(tail)) return fail();
        tail_ = tail;
        return true;
    }
    tail_ += step;
    if (padding) return true;
    ring_.shared->overwritten.store(++overwritten_, std::memory_order_relaxed);
    if (oldest.kind == layout::RecordKind::chunk) chunks_.take_back(oldest.sequence);
    return true;
}

/// Every step frees at least one line, so at most as many steps as the ring has lines suffice; a reader that takes records
/// at the same time reduces their number. If they do not suffice, the peer moves the tail back.
template <class A>
bool RingProducer<A>::drop_until_fits(std::uint64_t room) {
    for (std::uint64_t budget = ring_.capacity / layout::line + 1; budget > 0; --budget) {
        if (fits(room)) return true;
        if (corrupt_ || !drop_oldest()) return false;
    }
    return fits(room);
}

/// Finds a free chunk, or drops the oldest records until a chunk is free. Returns false if the reader holds all chunks or
/// there is no memory.
template <class A>
bool RingProducer<A>::claim_chunk(std::uint64_t bytes) {
    if (corrupt_ || ring_.chunk_count == 0) return false;
    chunks_.begin_message();
    bool found = chunks_.find_free(ring_, bytes);
    for (std::uint64_t budget = ring_.capacity / layout::line + 1; !found && budget > 0 && tail_ < head_;
         --budget) {
        if (!drop_oldest()) return false;
        found = chunks_.find_free(ring_, bytes);
    }
    if (!found) return false;
    ring_.chunk_words[chunks_.current()].filled_for.store(sequence_ + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release); // before the first byte of the content
    return true;
}

template <class A>
bool RingProducer<A>::refuse() {
    ring_.shared->sent.store(++sent_, std::memory_order_relaxed);
    ring_.shared->refused.store(++refused_, std::memory_order_relaxed);
    return false;
}

/// Drops no record: only commit() knows how many bytes are used.
template <class A>
typename RingProducer<A>::Reservation RingProducer<A>::reserve(std::size_t bytes) {
    reservation_ = Reservation::refused;
    reserved_bytes_ = bytes;
    if (!corrupt_ && bytes <= ring_.max_record)
        reservation_ = Reservation::scratch;
    else if (bytes > ring_.max_record && bytes <= ring_.chunk_bytes && claim_chunk(bytes))
        reservation_ = Reservation::chunk;
    if (reservation_ == Reservation::refused) refuse();
    return reservation_;
}

template <class A>
bool RingProducer<A>::commit(const void* scratch, std::size_t used, std::uint64_t stamp) {
    const bool in_chunk = std::exchange(reservation_, Reservation::refused) == Reservation::chunk;
    const ChunkReference reference{chunks_.current(), used};
    const std::size_t bytes = in_chunk ? sizeof reference : used;
    if (!drop_until_fits(room_for(record_size(bytes)))) return refuse();
    if (in_chunk) chunks_.lend(sequence_ + 1);
    const bool sampled = sample_age_of_next();
    publish(
        in_chunk ? layout::RecordKind::chunk : layout::RecordKind::data, padding_before(record_size(bytes)),
        bytes, stamp,
        [&](typename A::Cell* to) { copy_payload(to, in_chunk ? &reference : scratch, bytes, false); },
        sampled ? CommitWord::sampled_bit : 0);
    if (in_chunk) ring_.shared->bytes_sent.store(bytes_ += used - bytes, std::memory_order_relaxed);
    room_end_ = std::min(head_ + ring_.bytes_to_end(head_), tail_ + ring_.capacity - layout::line);
    return true;
}

/// Stores the 0 that means "no record yet" where the next record will begin.
template <class A>
inline void RingProducer<A>::clear_commit_word(std::uint64_t position) {
    A::store(*ring_.cell(position), 0, std::memory_order_release);
    cleared_at_ = position;
}

/// Clears the commit word after the next record in advance, assuming that the next record is as long as the last one.
/// Neither this store nor the transfer of its line then delays the next record.
template <class A>
inline void RingProducer<A>::prepare_next(std::uint64_t head, std::uint64_t record) {
    if (head + record <= room_end_) [[likely]]
        clear_commit_word(head + record);
}

/// Copies a full line of the commit word without a loop, in half of the instructions. This line comes last, directly before
/// the commit word: the reader polls it, and takes it away while the writer waits for the other lines. With
/// `readable_behind`, which is a constant, copies 16 bytes at a time to the end, after which the record has room.
template <class A>
inline void RingProducer<A>::copy_payload(typename A::Cell* to, const void* payload, std::size_t used,
                                          bool readable_behind) {
    constexpr std::size_t first_line = layout::line - layout::record_header, step = 2 * word_bytes;
    if (!readable_behind && used < first_line) return A::copy_atomic_to_shared(to, payload, used);
    const auto* const from = static_cast<const std::byte*>(payload);
    if (readable_behind)
        for (std::size_t at = first_line; at < used; at += step)
            A::copy_atomic_to_shared(to + at / word_bytes, from + at, step);
    else if (used > first_line)
        A::copy_atomic_to_shared(to + first_line / word_bytes, from + first_line, used - first_line);
    A::copy_atomic_to_shared(to, from, first_line);
}

template <class A>
bool RingProducer<A>::sample_age_of_next() {
    if (!sample_next_ && !is_sampled(sequence_ + 1)) return false;
    sample_next_ = false;
    sampled_ns_ = A::now();
    ring_.shared->sample.store(AgeSample::pack(sequence_ + 1, sampled_ns_), std::memory_order_relaxed);
    return true;
}

/// `copy_to` copies the payload to the given cells. `flags` go into the commit word.
template <class A>
template <class Copy>
inline void RingProducer<A>::publish(layout::RecordKind kind, std::uint64_t padding, std::size_t used,
                                     std::uint64_t stamp, Copy&& copy_to, std::uint64_t flags) {
    const std::uint64_t start = head_ + padding, record = record_size(used), end = start + record;
    const std::uint64_t sequence = ++sequence_;
    auto* const cells = ring_.cell(start); // the record is contiguous
    auto& shared = *ring_.shared;
    head_ = end;
    shared.write_limit.store(end + record + layout::line,
                             std::memory_order_relaxed); // up to prepare_next()'s word
    if (end != cleared_at_) [[unlikely]]
        clear_commit_word(end);
    copy_to(cells + layout::record_header / word_bytes);
    A::store(cells[1], stamp, std::memory_order_release);
    A::store(cells[0], CommitWord::pack(kind, used, sequence) | flags, std::memory_order_release);
    if (padding != 0)
        A::store(*ring_.cell(start - padding), CommitWord::pack(layout::RecordKind::padding, 0, sequence),
                 std::memory_order_release);
    shared.head.store(end, std::memory_order_release);
    shared.newest.store(start, std::memory_order_release);
    shared.published.store(sequence, std::memory_order_relaxed);
    shared.sent.store(++sent_, std::memory_order_relaxed);
    shared.bytes_sent.store(bytes_ += used, std::memory_order_relaxed);
    prepare_next(end, record);
}

/// Does not request these lines for writing: the reader polls the first of them and would have to fetch it again. But the
/// writer's words are stored again unchanged: an observer may have read them, and the commit word would wait for their
/// line.
template <class A>
void RingProducer<A>::prefetch_next(std::size_t bytes) {
    const auto prefetch = [](const auto* from, std::size_t size) {
        for (std::size_t at = 0; at < size; at += layout::line)
            __builtin_prefetch(reinterpret_cast<const std::byte*>(from) + at);
    };
    prefetch(ring_.shared, sizeof *ring_.shared);
    ring_.shared->sent.store(sent_, std::memory_order_relaxed);
    prefetch(ring_.cell(head_), std::min(record_size(bytes) + layout::line, ring_.bytes_to_end(head_)));
    if (A::now() - sampled_ns_ >= AgeSample::longest_pause_ns) sample_next();
}

/// Makes no call, so that no register has to be saved.
template <class A>
inline bool RingProducer<A>::write_behind_last(const void* bytes, std::size_t count, std::uint64_t stamp,
                                               bool readable_behind) {
    if (!fits_behind_last(count)) [[unlikely]]
        return false;
    reservation_ = Reservation::refused;
    publish(layout::RecordKind::data, 0, count, stamp,
            [&](typename A::Cell* to) { copy_payload(to, bytes, count, readable_behind); });
    return true;
}

template <class A>
inline bool RingProducer<A>::write_words_behind_last(std::uint64_t first, const void* others,
                                                     std::size_t count, std::uint64_t stamp) {
    const std::size_t bytes = (count + 1) * word_bytes;
    if (!fits_behind_last(bytes)) [[unlikely]]
        return false;
    reservation_ = Reservation::refused;
    publish(layout::RecordKind::data, 0, bytes, stamp, [&](typename A::Cell* to) {
        // Starts from the end, so that the line of the commit word comes last: see copy_payload().
        const auto* const from = static_cast<const std::byte*>(others);
        auto* const words = to + 1;
        std::size_t at = count;
        for (; at >= 2; at -= 2)
            A::copy_atomic_to_shared(words + at - 2, from + (at - 2) * word_bytes, 2 * word_bytes);
        if (at != 0) A::copy_atomic_to_shared(words, from, word_bytes);
        A::store(*to, first, std::memory_order_release);
    });
    return true;
}

template <class A>
bool RingProducer<A>::write(const void* bytes, std::size_t count, std::uint64_t stamp) {
    if (count <= ring_.max_record && write_behind_last(bytes, count, stamp, false)) return true;
    switch (reserve(count)) {
    case Reservation::refused:
        return false;
    case Reservation::chunk:
        std::memcpy(chunk(), bytes, count);
        break;
    case Reservation::scratch: // `bytes` serves as the scratch memory
        break;
    }
    return commit(bytes, count, stamp);
}

} // namespace tandem::shm
