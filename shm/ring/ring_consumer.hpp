// SPDX-License-Identifier: Apache-2.0
// The reading end of a ring, over whatever atomics. Inside of the ring: users include ring.hpp.
//
// The commit word of the next record is all that a waiting reader looks at; the order of the stores, and why
// a lossy ring's copy is whole when the tail could still be moved, stand in ring_producer.hpp.
//
// Nothing that stands in the ring is believed before it was checked against this process's own copy of the
// sizes, and nothing is used before it was copied (but by peek() and consume(), which say so). In a lossy
// ring a look may find the bytes of a record that is being overwritten. Such a look is not evidence of
// damage: only if the words that would have had to move have not moved, the bytes are impossible and the ring
// is given up.
#pragma once
#include "shm/os/futex.hpp"
#include "shm/ring/ring_view.hpp"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tandem::shm {

/// A received message; valid until the next read of the same reader, whatever the writer does.
struct Record {
    std::span<const std::byte> bytes; ///< 8-aligned
    std::uint64_t sequence;           ///< 1, 2, 3 ...; a gap is a drop after acceptance
    std::uint64_t stamp_ns;
    std::uint8_t tag;
};

template <class A>
class alignas(layout::line_pair) RingConsumer {
  public:
    explicit RingConsumer(const RingView<A>& ring);
    RingConsumer(RingConsumer&&) noexcept = default;
    RingConsumer& operator=(RingConsumer&&) = delete;

    bool empty() const;
    std::optional<Record> read() {
        return ring_.policy == RingPolicy::latest_only ? read_newest() : read_as(false);
    }
    std::optional<Record> read_newest() { return read_as(true); }
    std::optional<Record> peek();
    void release();
    template <class Use>
    std::size_t consume(Use&& use, std::size_t most);
    bool corrupt() const { return corrupt_; }

  private:
    enum class Look { nothing, found, unsound };
    struct Found {
        std::uint64_t start, end; // of the record itself, behind any padding
        Commit commit;
    };
    /// The chunk that the last record lies in; moving it on leaves none behind.
    struct Hold {
        typename A::template Atomic<std::uint64_t>* returned = nullptr;
        std::uint64_t sequence = 0;
        Hold() = default;
        Hold(Hold&& from) noexcept
            : returned(std::exchange(from.returned, nullptr)), sequence(from.sequence) {}
        Hold& operator=(Hold&&) = delete;
        ~Hold() { give_back(); }
        bool give_back() {
            if (returned == nullptr) return false;
            std::exchange(returned, nullptr)->store(sequence, std::memory_order_seq_cst);
            return true;
        }
    };

    /// A reader on the writer's heels takes each line away while the writer still writes to it, and both
    /// crawl. So a look that finds nothing right after a row of records that came without waiting costs half
    /// a microsecond, in which the writer gets ahead. Records that come one by one are not affected.
    class Pace {
      public:
        void something() {
            row_ = looks_ <= few ? row_ + 1 : 0;
            looks_ = 0;
        }
        void nothing() {
            if (looks_++ == 0 && row_ >= long_row)
                for (int i = 0; i < pauses; ++i) A::pause();
        }

      private:
        static constexpr unsigned few = 8, long_row = 16;
        static constexpr int pauses = 16;
        unsigned looks_ = few + 1, row_ = 0;
    };

    std::uint64_t current_tail() const {
        return ring_.lossy() ? ring_.shared->tail.load(std::memory_order_acquire) : position_;
    }
    Look look(std::uint64_t at, Found& found) const;
    Look look_newest(std::uint64_t tail, Found& found) const;
    bool damaged(std::uint64_t tail);
    bool move_tail(std::uint64_t& from, std::uint64_t to);
    void wake_writer();
    std::optional<Record> read_as(bool newest);
    std::optional<Record> receive(bool newest);
    bool copy(const Found& found);
    bool show(std::uint64_t at, std::uint64_t sequence, Found& found, Record& record);
    void hold_chunk(std::uint64_t sequence);
    void give_back();
    void give_back_before(std::uint64_t sequence);
    std::uint64_t sequence_of(const Found& found, std::uint64_t tail) const;
    bool take(const Found& found, std::uint64_t tail, std::uint64_t& skipped);
    Record deliver(const Found& found, std::uint64_t sequence, std::uint64_t skipped);
    void count(std::uint64_t sequence, std::uint64_t bytes);
    void publish_counts();

    // How often a lossy writer may overtake one read. Each time it has put a whole ring's worth of records in
    // the time of one copy.
    static constexpr int overtakings = 64;
    static constexpr std::size_t one_line = layout::line - layout::record_header; // payload that fits in it

    RingView<A> ring_;
    std::uint64_t position_; // end of what I consumed last; in lossy rings the shared tail may be further
    std::uint64_t sequence_; // of the record consumed last
    bool in_step_;           // sequence_ + 1 is that of the record at position_
    bool corrupt_ = false;
    std::uint64_t received_, bytes_;
    mutable Pace pace_;
    Hold hold_;
    std::vector<std::uint64_t> scratch_;
    std::uint64_t skipped_; // from here on rarely needed
    std::uint64_t stamp_ = 0;
    LoanRecord loan_{};
};

template <class A>
RingConsumer<A>::RingConsumer(const RingView<A>& ring)
    : ring_(ring), scratch_(std::max(round_up(ring.max_record, word_bytes), one_line) / word_bytes) {
    auto& shared = *ring_.shared;
    position_ = shared.tail.load(std::memory_order_acquire);
    received_ = shared.received.load(std::memory_order_relaxed);
    skipped_ = shared.skipped.load(std::memory_order_relaxed);
    bytes_ = shared.bytes_received.load(std::memory_order_relaxed);
    // In a lossy ring the writer may be dropping records at this moment.
    sequence_ = received_ + skipped_;
    in_step_ = !ring_.lossy();
    corrupt_ = position_ % layout::line != 0;
}

/// The usual case, all in a few instructions behind one load: the next record in sequence, in the ring
/// itself. Everything else goes the long way: receive().
template <class A>
inline std::optional<Record> RingConsumer<A>::read_as(bool newest) {
    const auto* at = ring_.cell(position_);
    const std::uint64_t word = A::load(*at, std::memory_order_acquire);
    const std::uint64_t wanted = Commit::word(layout::RecordKind::record, 0, 0, sequence_ + 1);
    const std::uint64_t length = Commit::of(word).length;
    if (((word ^ wanted) & Commit::kind_and_sequence) != 0 || length > ring_.max_record ||
        record_bytes(length) > ring_.to_end(position_) || hold_.returned != nullptr || !in_step_ || corrupt_)
        return receive(newest);
    const std::uint64_t end = position_ + record_bytes(length);
    if (newest && A::load(*ring_.cell(end), std::memory_order_acquire) != 0) return receive(newest);
    // The rest of the line comes along: what is behind the payload is nobody's.
    const bool lossy = ring_.lossy();
    if (lossy)
        A::copy_out(scratch_.data(), at + 2, one_line);
    else
        A::take_out(scratch_.data(), at + 2, one_line);
    if (length > one_line && lossy)
        A::copy_out(scratch_.data() + one_line / word_bytes, at + 8, length - one_line);
    else if (length > one_line)
        A::take_out(scratch_.data() + one_line / word_bytes, at + 8, length - one_line);
    const std::uint64_t stamp = A::load(*(at + 1), std::memory_order_acquire);
    std::uint64_t from = position_;
    if (!move_tail(from, end)) return receive(newest);
    count(sequence_ + 1, length);
    ring_.shared->received.store(received_, std::memory_order_relaxed);
    ring_.shared->bytes_received.store(bytes_, std::memory_order_relaxed);
    return Record{{reinterpret_cast<const std::byte*>(scratch_.data()), length},
                  sequence_,
                  stamp,
                  Commit::of(word).tag};
}

/// True if there is nothing to read: one load of a line (two in a lossy ring) that stays in this core's cache
/// until the writer writes there. The line behind it is asked for at the same time, for records of two lines.
template <class A>
bool RingConsumer<A>::empty() const {
    A::prefetch(ring_.cell(position_ + layout::line));
    if (A::load(*ring_.cell(position_), std::memory_order_acquire) != 0) return false;
    pace_.nothing();
    // Overtaken, what stands there may be any word of a younger record, 0 included.
    return !ring_.lossy() || ring_.shared->tail.load(std::memory_order_relaxed) == position_;
}

/// The record at `at`, or behind the padding there.
template <class A>
typename RingConsumer<A>::Look RingConsumer<A>::look(std::uint64_t at, Found& found) const {
    std::uint64_t word = A::load(*ring_.cell(at), std::memory_order_acquire);
    if (word == 0) return Look::nothing;
    if (Commit::of(word).kind == layout::RecordKind::padding) {
        at += ring_.to_end(at);
        word = A::load(*ring_.cell(at), std::memory_order_acquire);
    }
    found = {at, at + record_bytes(Commit::of(word).length), Commit::of(word)};
    const auto [kind, length, tag, sequence] = found.commit;
    const bool sound =
        (kind == layout::RecordKind::record && length <= ring_.max_record) ||
        (kind == layout::RecordKind::loan && length == sizeof(LoanRecord) && ring_.chunk_count != 0);
    return sound && found.end - at <= ring_.to_end(at) ? Look::found : Look::unsound;
}

/// The newest record from `tail` on. The word `newest` may lag behind by one record, for a moment or (writer
/// killed between two stores) for ever, hence the last steps. A reader that is up to date does not look at it
/// at all, but at the line where the next record will come.
template <class A>
typename RingConsumer<A>::Look RingConsumer<A>::look_newest(std::uint64_t tail, Found& found) const {
    const Look oldest = look(tail, found);
    Found next;
    Look after = oldest == Look::found ? look(found.end, next) : Look::nothing;
    if (after == Look::nothing) return oldest;
    const std::uint64_t newest = ring_.shared->newest.load(std::memory_order_acquire);
    if (newest > found.start && newest - tail < ring_.capacity && newest % layout::line == 0) {
        if (look(newest, found) != Look::found) return Look::unsound;
        after = look(found.end, next);
    }
    constexpr int lag = 4;
    for (int i = 0; i < lag && after == Look::found; ++i) {
        found = next;
        after = look(found.end, next);
    }
    return after == Look::unsound ? after : Look::found;
}

/// A look was unsound: is it the ring, or was this end overtaken while it looked?
template <class A>
bool RingConsumer<A>::damaged(std::uint64_t tail) {
    corrupt_ = current_tail() == tail;
    return corrupt_;
}

/// False: it is a loan of no chunk of this ring.
template <class A>
bool RingConsumer<A>::copy(const Found& found) {
    const auto* payload = ring_.cell(found.start + layout::record_header);
    const bool loan = found.commit.kind == layout::RecordKind::loan;
    void* to = loan ? static_cast<void*>(&loan_) : scratch_.data();
    if (ring_.lossy())
        A::copy_out(to, payload, found.commit.length);
    else
        A::take_out(to, payload, found.commit.length);
    stamp_ = A::load(*ring_.cell(found.start + word_bytes), std::memory_order_acquire);
    return !loan || (loan_.chunk < ring_.chunk_count && loan_.bytes <= ring_.chunk_bytes);
}

/// The 24 bits of the commit word made 64 again: counted on from the last one, or, when the writer has
/// dropped records meanwhile, by its own count. That one is read before the tail is moved, and the record was
/// in the ring until then: so it cannot be further off than there are lines in the ring.
template <class A>
std::uint64_t RingConsumer<A>::sequence_of(const Found& found, std::uint64_t tail) const {
    if (in_step_ && tail == position_)
        return sequence_ + ((found.commit.sequence - sequence_) & layout::sequence_mask);
    const std::uint64_t near = ring_.shared->published.load(std::memory_order_relaxed) + 1;
    return near - ((near - found.commit.sequence) & layout::sequence_mask);
}

template <class A>
void RingConsumer<A>::wake_writer() {
    if (ring_.policy == RingPolicy::wait) wake<A>(ring_.shared->writer_sleeps);
}

/// Takes [from, to). False: the writer was faster, `from` is the tail now. seq_cst for the writer that waits
/// for room, see RingProducer::fits().
template <class A>
inline bool RingConsumer<A>::move_tail(std::uint64_t& from, std::uint64_t to) {
    auto& tail = ring_.shared->tail;
    if (ring_.lossy()) {
        if (!tail.compare_exchange_strong(from, to, std::memory_order_acq_rel, std::memory_order_acquire))
            return false;
    } else if (ring_.policy == RingPolicy::wait) {
        tail.store(to, std::memory_order_seq_cst);
    } else {
        tail.store(to, std::memory_order_release);
    }
    position_ = to;
    wake_writer();
    return true;
}

/// Moves the tail from wherever it is to behind `found`. The copy made before is whole as long as the tail
/// has not passed the record's begin; the word that stands at the tail until then says which sequence number
/// is the oldest (padding has that of the record behind it).
template <class A>
bool RingConsumer<A>::take(const Found& found, std::uint64_t tail, std::uint64_t& skipped) {
    for (int i = 0; i < overtakings && tail <= found.start; ++i) {
        const auto oldest = Commit::of(A::load(*ring_.cell(tail), std::memory_order_acquire));
        skipped = (found.commit.sequence - oldest.sequence) & layout::sequence_mask;
        if (move_tail(tail, found.end)) return true;
    }
    return false;
}

template <class A>
inline void RingConsumer<A>::count(std::uint64_t sequence, std::uint64_t bytes) {
    pace_.something();
    sequence_ = sequence;
    in_step_ = true;
    ++received_;
    bytes_ += bytes;
    if (sequence % Sample::every != 0) return;
    const std::uint64_t sample = ring_.shared->sample.load(std::memory_order_relaxed);
    if (Sample::is_of(sample, sequence)) ring_.shared->age.add(Sample::age(sample, A::now()));
}

template <class A>
void RingConsumer<A>::publish_counts() {
    auto& shared = *ring_.shared;
    shared.received.store(received_, std::memory_order_relaxed);
    shared.skipped.store(skipped_, std::memory_order_relaxed);
    shared.bytes_received.store(bytes_, std::memory_order_relaxed);
}

template <class A>
void RingConsumer<A>::hold_chunk(std::uint64_t sequence) {
    hold_.returned = &ring_.chunk_words[loan_.chunk].returned;
    hold_.sequence = sequence;
}

template <class A>
void RingConsumer<A>::give_back() {
    if (hold_.give_back()) wake_writer();
}

/// Which chunks the skipped records lay in is not looked up: whatever was lent before this record is given
/// back.
template <class A>
void RingConsumer<A>::give_back_before(std::uint64_t sequence) {
    if (ring_.chunk_count == 0) return;
    for (std::uint32_t i = 0; i < ring_.chunk_count; ++i)
        ring_.chunk_words[i].returned.store(sequence - 1, std::memory_order_seq_cst);
    wake_writer();
}

template <class A>
[[gnu::noinline]] std::optional<Record> RingConsumer<A>::receive(bool newest) {
    give_back();
    for (int i = 0; i < overtakings && !corrupt_; ++i) {
        const std::uint64_t tail = current_tail();
        corrupt_ = tail % layout::line != 0 || tail < position_;
        if (corrupt_) break;
        Found found;
        const Look seen = newest ? look_newest(tail, found) : look(tail, found);
        if (seen == Look::nothing && current_tail() == tail) {
            // The writer has moved the tail to here for a record that it has not finished, and perhaps never
            // will: here is where empty() and the next read shall look.
            in_step_ = in_step_ && tail == position_;
            position_ = tail;
            return std::nullopt;
        }
        if (seen == Look::nothing || ((seen == Look::unsound || !copy(found)) && !damaged(tail))) continue;
        if (corrupt_) break;
        const bool in_step = in_step_ && tail == position_;
        const std::uint64_t sequence = sequence_of(found, tail);
        std::uint64_t skipped = 0;
        if (!take(found, tail, skipped)) continue;
        corrupt_ = in_step && !newest && sequence != sequence_ + 1; // not what the writer wrote there
        if (corrupt_) break;
        return deliver(found, sequence, skipped);
    }
    return std::nullopt;
}

template <class A>
Record RingConsumer<A>::deliver(const Found& found, std::uint64_t sequence, std::uint64_t skipped) {
    const bool loan = found.commit.kind == layout::RecordKind::loan;
    if (skipped != 0) give_back_before(sequence);
    if (loan) hold_chunk(sequence);
    const std::byte* bytes = loan ? ring_.chunk(static_cast<std::uint32_t>(loan_.chunk))
                                  : reinterpret_cast<const std::byte*>(scratch_.data());
    const std::size_t length = loan ? loan_.bytes : found.commit.length;
    skipped_ += skipped;
    count(sequence, length);
    publish_counts();
    return {{bytes, length}, sequence, stamp_, found.commit.tag};
}

/// In place: what peek() and consume() show lies in shared memory, and only an honest writer leaves it alone.
template <class A>
bool RingConsumer<A>::show(std::uint64_t at, std::uint64_t sequence, Found& found, Record& record) {
    const Look seen = look(at, found);
    if (seen == Look::nothing) return false;
    const bool loan = found.commit.kind == layout::RecordKind::loan;
    const auto* payload = ring_.cell(found.start + layout::record_header);
    if (seen == Look::found && loan) A::take_out(&loan_, payload, sizeof loan_);
    corrupt_ = seen == Look::unsound || found.commit.sequence != (sequence & layout::sequence_mask) ||
               (loan && (loan_.chunk >= ring_.chunk_count || loan_.bytes > ring_.chunk_bytes));
    if (corrupt_) return false;
    const std::byte* bytes = loan ? ring_.chunk(static_cast<std::uint32_t>(loan_.chunk))
                                  : reinterpret_cast<const std::byte*>(payload);
    record = {{bytes, loan ? loan_.bytes : found.commit.length},
              sequence,
              A::load(*ring_.cell(found.start + word_bytes), std::memory_order_relaxed),
              found.commit.tag};
    return true;
}

template <class A>
std::optional<Record> RingConsumer<A>::peek() {
    Found found;
    Record record;
    if (corrupt_ || !show(position_, sequence_ + 1, found, record)) return std::nullopt;
    return record;
}

template <class A>
void RingConsumer<A>::release() {
    consume([](const Record&) {}, 1);
}

/// Hands up to `most` records to use(const Record&), in place and in order, then gives their room back at
/// once. Returns how many.
template <class A>
template <class Use>
std::size_t RingConsumer<A>::consume(Use&& use, std::size_t most) {
    give_back();
    std::size_t done = 0;
    std::uint64_t at = position_;
    Found found;
    Record record;
    for (; done < most && !corrupt_ && show(at, sequence_ + 1, found, record); ++done) {
        use(static_cast<const Record&>(record));
        if (found.commit.kind == layout::RecordKind::loan) {
            hold_chunk(record.sequence);
            give_back();
        }
        count(record.sequence, record.bytes.size());
        at = found.end;
    }
    if (done == 0) {
        pace_.nothing();
        return 0;
    }
    std::uint64_t from = position_;
    move_tail(from, at);
    publish_counts();
    return done;
}

} // namespace tandem::shm
