// SPDX-License-Identifier: Apache-2.0
// The writing end of a ring, over whatever atomics. Inside of the ring: users include ring.hpp.
//
// head is this end's own; everybody else's word is checked before it is used. One publication stores, in this
// order, each release:
//
//     0 where the next record will begin | payload, stamp | commit word (| padding before it) | head | newest
//
// Killed anywhere before the commit word (of the padding, if there is one: it is what the reader looks at),
// it has published nothing. Two ways to the bytes:
//
// Lossless (reject, wait): the payload is written in place. Only the reader moves the tail, so what lies
// between head and tail + capacity is this end's alone:
//
//     writer: payload | commit (release)            reader: commit (acquire) | copy | tail = t (release)
//     writer: t = tail (acquire) | overwrites what lies before t
//
// Lossy (latest_only, drop_oldest): the writer takes the oldest records away by moving the tail itself, and
// the reader may be in the midst of copying them. Then the reader must find out (SOFI: the copy counts only
// if the reader can still move the tail from where it was):
//
//     writer: W1 CAS tail t -> t'  | W2 stores words over [t, t') (release, each)
//     reader: R1 loads tail t      | R2 loads words of [t, t') (acquire, each)    | R3 CAS tail t -> t'
//
//     If any R2 saw a word of W2, that pair synchronizes, W1 happens before R3, and R3 fails (the tail only
//     grows, so it is never t again). If R3 succeeds, no R2 saw W2, and the copy is whole.
//
// So those stores must be word-wise atomic ones: the payload is made elsewhere and copied in.
#pragma once
#include "shm/os/futex.hpp"
#include "shm/ring/ring_view.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace tandem::shm {

/// On lines of its own: in one process, a reader in the same line would make every write a transfer.
template <class A>
class alignas(layout::line_pair) RingProducer {
  public:
    explicit RingProducer(const RingView<A>& ring);

    /// Where reserve() has found room. refused: nowhere, which counts as one sent and dropped.
    enum class Place { refused, ring, elsewhere, chunk };

    /// ring: write to cells(). elsewhere (lossy rings, short payloads): anywhere, and give it to commit().
    /// chunk: write to chunk().
    Place reserve(std::size_t bytes);
    typename A::Cell* cells() const { return ring_.cell(start_of_reserved() + layout::record_header); }
    std::byte* chunk() const { return ring_.chunk(chunk_); }
    bool open() const { return place_ != Place::refused; }
    std::size_t reserved() const { return reserved_; }
    void abandon() { place_ = Place::refused; }

    /// Publishes the first `used` bytes. False: refused and counted after all.
    bool commit(const void* elsewhere, std::size_t used, std::uint64_t stamp, std::uint8_t tag);

    /// All in one.
    bool write(const void* bytes, std::size_t count, std::uint64_t stamp, std::uint8_t tag);

    bool corrupt() const { return corrupt_; }
    std::uint64_t longest() const { return std::max(ring_.max_record, ring_.chunk_bytes); }

  private:
    std::uint64_t padding_before(std::uint64_t record) const {
        return record <= ring_.to_end(head_) ? 0 : ring_.to_end(head_);
    }
    std::uint64_t start_of_reserved() const { return head_ + padding_before(record_bytes(reserved_)); }
    std::uint64_t need(std::uint64_t record) const { return padding_before(record) + record + layout::line; }
    bool plausible(std::uint64_t tail) const;
    bool fits(std::uint64_t need);
    template <class Ready>
    bool wait_until_ready(Ready&& ready);
    bool make_room(std::uint64_t need);
    bool drop_oldest();
    bool drop_until_fits(std::uint64_t need);
    bool chunk_is_free(std::uint32_t index) const;
    bool back_chunk(std::uint32_t index, std::uint64_t bytes);
    bool find_chunk(std::uint64_t bytes);
    bool claim_chunk(std::uint64_t bytes);
    bool refuse();
    bool write_slowly(const void* bytes, std::size_t count, std::uint64_t stamp, std::uint8_t tag);
    void end_at(std::uint64_t end);
    void expect_another(std::uint64_t record);
    void publish(layout::RecordKind kind, const void* payload, std::uint64_t padding, std::size_t used,
                 std::uint64_t stamp, std::uint8_t tag);

    static constexpr std::uint64_t nowhere = ~std::uint64_t{0};

    RingView<A> ring_;
    std::uint64_t head_, tail_; // head is mine; tail as last seen
    std::uint64_t ended_at_;    // where 0 was stored last
    std::uint64_t sequence_;    // of the newest record
    std::uint64_t sent_, refused_, overwritten_, bytes_;
    Place place_ = Place::refused;
    std::size_t reserved_ = 0;
    std::uint32_t chunk_ = 0;
    std::vector<std::uint64_t> loans_;  // per chunk: sequence of the record that holds it, 0 = none
    std::vector<std::uint64_t> backed_; // per chunk: bytes that have memory, if the ring gives it bit by bit
    bool no_memory_ = false;
    bool corrupt_ = false;
};

template <class A>
RingProducer<A>::RingProducer(const RingView<A>& ring)
    : ring_(ring), loans_(ring.chunk_count), backed_(ring.back != nullptr ? ring.chunk_count : 0) {
    auto& shared = *ring_.shared;
    head_ = ended_at_ = shared.head.load(std::memory_order_acquire);
    tail_ = 0;
    tail_ = shared.tail.load(std::memory_order_acquire);
    sent_ = shared.sent.load(std::memory_order_relaxed);
    refused_ = shared.refused.load(std::memory_order_relaxed);
    overwritten_ = shared.overwritten.load(std::memory_order_relaxed);
    bytes_ = shared.bytes_sent.load(std::memory_order_relaxed);
    sequence_ = shared.published.load(std::memory_order_relaxed);
    corrupt_ = head_ % layout::line != 0 || !plausible(tail_);
}

template <class A>
bool RingProducer<A>::plausible(std::uint64_t tail) const {
    return tail >= tail_ && tail <= head_ && head_ - tail <= ring_.capacity && tail % layout::line == 0;
}

template <class A>
bool RingProducer<A>::fits(std::uint64_t need) {
    if (head_ + need - tail_ <= ring_.capacity) return true; // as last seen: no look at the reader's line
    // seq_cst for RingPolicy::wait: this end announces its sleep and looks at the tail, the reader moves the
    // tail and looks for the announcement (futex.hpp).
    const std::uint64_t tail = ring_.shared->tail.load(std::memory_order_seq_cst);
    if (!plausible(tail)) corrupt_ = true;
    if (corrupt_) return false;
    tail_ = tail;
    return head_ + need - tail_ <= ring_.capacity;
}

template <class A>
template <class Ready>
bool RingProducer<A>::wait_until_ready(Ready&& ready) {
    const std::uint64_t deadline = A::now() + ring_.wait_ns;
    wait_until<A>(ring_.shared->writer_sleeps, {}, deadline, [&] { return ready() || corrupt_; });
    return !corrupt_ && ready();
}

template <class A>
bool RingProducer<A>::make_room(std::uint64_t need) {
    if (corrupt_) return false;
    if (ring_.lossy() || fits(need)) return true; // a lossy ring drops when it knows the exact length
    return ring_.policy == RingPolicy::wait && wait_until_ready([&] { return fits(need); });
}

/// Takes the record at the tail away, or the padding there; the reader may be faster.
template <class A>
bool RingProducer<A>::drop_oldest() {
    const Commit oldest = Commit::of(A::load(*ring_.cell(tail_), std::memory_order_relaxed));
    const bool padding = oldest.kind == layout::RecordKind::padding;
    const std::uint64_t step = padding ? ring_.to_end(tail_) : record_bytes(oldest.length);
    // Every word from tail_ on was written by this end, even if the reader has moved on since.
    if (oldest.kind == layout::RecordKind::none || step > ring_.to_end(tail_) || step > head_ - tail_)
        return corrupt_ = true, false;
    std::uint64_t tail = tail_;
    const bool dropped = ring_.shared->tail.compare_exchange_strong(
        tail, tail_ + step, std::memory_order_acq_rel, std::memory_order_acquire);
    if (dropped) {
        tail_ += step;
        if (padding) return true;
        ring_.shared->overwritten.store(++overwritten_, std::memory_order_relaxed);
        if (oldest.kind == layout::RecordKind::loan)
            for (auto& loan : loans_)
                if ((loan & layout::sequence_mask) == oldest.sequence) loan = 0;
        return true;
    }
    if (!plausible(tail)) return corrupt_ = true, false;
    tail_ = tail;
    return true;
}

// Every step frees at least a line, so as many as there are lines suffice; a reader taking records at the
// same time only shortens the way. More steps than that: somebody moves the tail who must not.
template <class A>
bool RingProducer<A>::drop_until_fits(std::uint64_t need) {
    for (std::uint64_t budget = ring_.capacity / layout::line + 1; budget > 0; --budget) {
        if (fits(need)) return true;
        if (corrupt_ || !drop_oldest()) return false;
    }
    return fits(need);
}

template <class A>
bool RingProducer<A>::chunk_is_free(std::uint32_t index) const {
    return loans_[index] == 0 ||
           ring_.chunk_words[index].returned.load(std::memory_order_seq_cst) >= loans_[index];
}

/// False: there is no memory for it. Then another chunk may have some.
template <class A>
bool RingProducer<A>::back_chunk(std::uint32_t index, std::uint64_t bytes) {
    if (ring_.back == nullptr || bytes <= backed_[index]) return true;
    constexpr std::uint64_t step = std::uint64_t{1} << 20; // so that growing messages do not ask each time
    for (const std::uint64_t unit : {step, std::uint64_t{layout::page}}) {
        const std::uint64_t wanted = std::min(round_up(bytes, unit), ring_.chunk_bytes);
        if (no_memory_ || !ring_.back(ring_, index, wanted)) continue;
        backed_[index] = wanted;
        return true;
    }
    no_memory_ = true; // asked once for each message
    return false;
}

/// Round robin from the one used last, so that a chunk comes back late and its lines are cold for the
/// reader's core only when all others are in use.
template <class A>
bool RingProducer<A>::find_chunk(std::uint64_t bytes) {
    for (std::uint32_t i = 1; i <= ring_.chunk_count; ++i) {
        const std::uint32_t index = (chunk_ + i) % ring_.chunk_count;
        if (!chunk_is_free(index) || !back_chunk(index, bytes)) continue;
        loans_[index] = 0;
        chunk_ = index;
        return true;
    }
    return false;
}

template <class A>
bool RingProducer<A>::claim_chunk(std::uint64_t bytes) {
    if (corrupt_ || ring_.chunk_count == 0) return false;
    no_memory_ = false;
    if (find_chunk(bytes)) return true;
    if (ring_.policy == RingPolicy::wait) return wait_until_ready([&] { return find_chunk(bytes); });
    if (!ring_.lossy()) return false;
    for (std::uint64_t budget = ring_.capacity / layout::line + 1; budget > 0 && tail_ < head_; --budget) {
        if (!drop_oldest()) return false;
        if (find_chunk(bytes)) return true;
    }
    return false; // the reader holds them all
}

template <class A>
bool RingProducer<A>::refuse() {
    ring_.shared->sent.store(++sent_, std::memory_order_relaxed);
    ring_.shared->refused.store(++refused_, std::memory_order_relaxed);
    return false;
}

template <class A>
typename RingProducer<A>::Place RingProducer<A>::reserve(std::size_t bytes) {
    place_ = Place::refused;
    reserved_ = bytes;
    if (bytes <= ring_.max_record) {
        if (make_room(need(record_bytes(bytes))))
            place_ = ring_.lossy() || bytes <= ring_.longest_burst ? Place::elsewhere : Place::ring;
        if (place_ == Place::ring) ended_at_ = nowhere; // the user may write over it, and abandon
    } else if (bytes <= ring_.chunk_bytes && make_room(need(record_bytes(sizeof(LoanRecord))))) {
        if (claim_chunk(bytes)) place_ = Place::chunk;
    }
    if (place_ == Place::refused) refuse();
    return place_;
}

template <class A>
bool RingProducer<A>::commit(const void* elsewhere, std::size_t used, std::uint64_t stamp, std::uint8_t tag) {
    const Place place = std::exchange(place_, Place::refused);
    using layout::RecordKind;
    if (place == Place::ring) {
        // In place, the payload lies where reserve() had to put a record of the full length.
        publish(RecordKind::record, nullptr, padding_before(record_bytes(reserved_)), used, stamp, tag);
        return true;
    }
    const LoanRecord loan{chunk_, used};
    const bool by_loan = place == Place::chunk;
    const std::size_t bytes = by_loan ? sizeof loan : used;
    if (ring_.lossy() && !drop_until_fits(need(record_bytes(bytes)))) return refuse();
    if (by_loan) loans_[chunk_] = sequence_ + 1;
    publish(by_loan ? RecordKind::loan : RecordKind::record, by_loan ? &loan : elsewhere,
            padding_before(record_bytes(bytes)), bytes, stamp, tag);
    if (by_loan) ring_.shared->bytes_sent.store(bytes_ += used - bytes, std::memory_order_relaxed);
    return true;
}

/// Marks where the next record will begin.
template <class A>
inline void RingProducer<A>::end_at(std::uint64_t end) {
    if (end != ended_at_) A::store(*ring_.cell(end), 0, std::memory_order_release);
    ended_at_ = end;
}

/// The same for the record after the one just published, as if that will be as long: it takes the store, and
/// the transfer of its line, off the way of the next record.
template <class A>
inline void RingProducer<A>::expect_another(std::uint64_t record) {
    if (record <= ring_.to_end(head_) && head_ + record + layout::line - tail_ <= ring_.capacity)
        end_at(head_ + record);
}

template <class A>
inline void RingProducer<A>::publish(layout::RecordKind kind, const void* payload, std::uint64_t padding,
                                     std::size_t used, std::uint64_t stamp, std::uint8_t tag) {
    const std::uint64_t start = head_ + padding;
    const std::uint64_t end = start + record_bytes(used);
    end_at(end);
    if (payload != nullptr) {
        if (ring_.lossy())
            A::copy_in(ring_.cell(start + layout::record_header), payload, used);
        else
            A::put_in(ring_.cell(start + layout::record_header), payload, used);
    }
    ++sequence_;
    if (sequence_ % Sample::every == 0)
        ring_.shared->sample.store(Sample::word(sequence_, A::now()), std::memory_order_relaxed);
    A::store(*ring_.cell(start + word_bytes), stamp, std::memory_order_release);
    A::store(*ring_.cell(start), Commit::word(kind, used, tag, sequence_), std::memory_order_release);
    if (padding != 0)
        A::store(*ring_.cell(head_), Commit::word(layout::RecordKind::padding, 0, 0, sequence_),
                 std::memory_order_release);
    head_ = end;
    auto& shared = *ring_.shared;
    shared.head.store(end, std::memory_order_release);
    shared.newest.store(start, std::memory_order_release);
    shared.published.store(sequence_, std::memory_order_relaxed);
    shared.sent.store(++sent_, std::memory_order_relaxed);
    shared.bytes_sent.store(bytes_ += used, std::memory_order_relaxed);
    expect_another(record_bytes(used));
}

/// The usual case, a record that fits where the last one ended, without the detours of reserve() and
/// commit().
template <class A>
inline bool RingProducer<A>::write(const void* bytes, std::size_t count, std::uint64_t stamp,
                                   std::uint8_t tag) {
    const std::uint64_t record = record_bytes(count);
    if (count <= ring_.max_record && record <= ring_.to_end(head_) &&
        head_ + record + layout::line - tail_ <= ring_.capacity && !corrupt_) {
        place_ = Place::refused;
        publish(layout::RecordKind::record, bytes, 0, count, stamp, tag);
        return true;
    }
    return write_slowly(bytes, count, stamp, tag);
}

template <class A>
[[gnu::noinline]] bool RingProducer<A>::write_slowly(const void* bytes, std::size_t count,
                                                     std::uint64_t stamp, std::uint8_t tag) {
    switch (reserve(count)) {
    case Place::refused:
        return false;
    case Place::ring:
        A::put_in(cells(), bytes, count);
        break;
    case Place::chunk:
        std::memcpy(chunk(), bytes, count);
        break;
    case Place::elsewhere:
        break;
    }
    return commit(bytes, count, stamp, tag);
}

} // namespace tandem::shm
