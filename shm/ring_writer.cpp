// SPDX-License-Identifier: Apache-2.0
// Two ways to the ring's bytes.
//
// Lossless (reject, wait): the payload is written in place. Only the reader moves the tail, so what lies
// between head and tail + capacity is the writer's alone:
//
//     writer: payload | head = h (release)        reader: h = head (acquire) | copy | tail = t (release)
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
// So the stores must be word-wise atomic ones. The user fills a private scratch with plain stores and
// commit() copies it in; that also means that the exact length is known before anything is dropped.
//
// Killed anywhere before `head` is stored, the writer has published nothing.
#include "shm/error.hpp"
#include "shm/futex.hpp"
#include "shm/ring.hpp"
#include "shm/shared_copy.hpp"

namespace tandem::shm {

using layout::RecordHeader;

RingWriter::RingWriter(RingHandle ring) : ring_(std::move(ring)) {
    if (ring_.writer != ring_.mapping->side())
        throw Error(ring_.mapping->path() + ": a ring written by side " + name_of(ring_.writer) +
                    " cannot be written here; use RingReader");
    auto& shared = *ring_.shared;
    head_ = shared.head.load(std::memory_order_acquire);
    tail_ = shared.tail.load(std::memory_order_acquire);
    sent_ = shared.sent.load(std::memory_order_relaxed);
    refused_ = shared.refused.load(std::memory_order_relaxed);
    overwritten_ = shared.overwritten.load(std::memory_order_relaxed);
    bytes_ = shared.bytes_sent.load(std::memory_order_relaxed);
    sequence_ = sent_ - refused_;
    if (head_ % word_bytes != 0 || !plausible(tail_))
        throw Error(ring_.mapping->path() +
                    ": a ring to be written is damaged; leave the segment and join again");
    if (ring_.lossy()) scratch_.resize(round_up(ring_.max_record, word_bytes) / word_bytes);
}

bool RingWriter::plausible(std::uint64_t tail) const {
    return tail >= tail_ && tail <= head_ && head_ - tail <= ring_.capacity && tail % word_bytes == 0;
}

std::uint64_t RingWriter::padding_before(std::uint64_t record) const {
    const std::uint64_t to_end = ring_.capacity - (head_ & (ring_.capacity - 1));
    return record <= to_end ? 0 : to_end;
}

bool RingWriter::fits(std::uint64_t need) {
    if (head_ + need - tail_ <= ring_.capacity) return true; // as last seen: no look at the reader's line
    const std::uint64_t tail = ring_.shared->tail.load(std::memory_order_seq_cst);
    if (!plausible(tail)) corrupt_ = true;
    if (corrupt_) return false;
    tail_ = tail;
    return head_ + need - tail_ <= ring_.capacity;
}

bool RingWriter::wait_for_room(std::uint64_t need) {
    const auto deadline = deadline_after(std::chrono::nanoseconds(ring_.wait_ns));
    wait_until(ring_.shared->writer_sleeps, {}, deadline, [&] { return fits(need) || corrupt_; });
    return !corrupt_ && fits(need);
}

// Every step frees at least one word, so capacity / 8 of them suffice; a reader taking records at the same
// time only shortens the way. More steps than that: somebody moves the tail who must not.
bool RingWriter::drop_until_fits(std::uint64_t need) {
    for (std::uint64_t budget = ring_.capacity / word_bytes + 1; budget > 0 && !fits(need) && !corrupt_;
         --budget) {
        const std::uint64_t offset = tail_ & (ring_.capacity - 1);
        const std::uint64_t to_end = ring_.capacity - offset;
        const auto length = static_cast<std::uint32_t>(load_word(ring_.data + offset));
        const bool padding = length == layout::padding_length;
        const std::uint64_t step = padding ? to_end : record_bytes(length);
        if (step > to_end || step > head_ - tail_) {
            corrupt_ = true;
            break;
        }
        std::uint64_t tail = tail_;
        if (ring_.shared->tail.compare_exchange_strong(tail, tail_ + step, std::memory_order_acq_rel) &&
            !padding)
            ++overwritten_;
    }
    return !corrupt_ && fits(need);
}

void RingWriter::refuse() {
    ring_.shared->sent.store(++sent_, std::memory_order_relaxed);
    ring_.shared->refused.store(++refused_, std::memory_order_relaxed);
}

std::span<std::byte> RingWriter::reserve(std::size_t bytes) {
    reserved_ = nothing;
    const std::uint64_t record = bytes <= ring_.max_record ? record_bytes(bytes) : 0;
    const std::uint64_t padding = padding_before(record);
    const bool room = record != 0 && !corrupt_ &&
                      (ring_.lossy() || fits(padding + record) ||
                       (ring_.policy == RingPolicy::wait && wait_for_room(padding + record)));
    if (!room) {
        refuse();
        return {};
    }
    reserved_ = bytes;
    if (ring_.lossy()) return {reinterpret_cast<std::byte*>(scratch_.data()), bytes};
    const std::uint64_t start = head_ + padding;
    return {ring_.data + (start & (ring_.capacity - 1)) + sizeof(RecordHeader), bytes};
}

void RingWriter::commit(std::size_t used, std::uint64_t stamp_ns, std::uint32_t tag) {
    if (reserved_ == nothing || used > reserved_)
        throw std::logic_error("RingWriter::commit: more than was reserved");
    const std::uint64_t record = record_bytes(used);
    // In place, the payload lies where reserve() had to put a record of the full length.
    const std::uint64_t padding = padding_before(ring_.lossy() ? record : record_bytes(reserved_));
    reserved_ = nothing;
    if (ring_.lossy() && !drop_until_fits(padding + record)) return refuse();
    if (padding != 0) store_word(ring_.data + (head_ & (ring_.capacity - 1)), layout::padding_length);
    publish(head_ + padding, used, stamp_ns, tag);
}

void RingWriter::publish(std::uint64_t start, std::size_t used, std::uint64_t stamp_ns, std::uint32_t tag) {
    std::byte* at = ring_.data + (start & (ring_.capacity - 1));
    store_word(at, used | static_cast<std::uint64_t>(tag) << 32U);
    store_word(at + offsetof(RecordHeader, sequence), ++sequence_);
    store_word(at + offsetof(RecordHeader, stamp_ns), stamp_ns);
    if (ring_.lossy()) copy_to_shared(at + sizeof(RecordHeader), scratch_.data(), used);
    head_ = start + record_bytes(used);
    auto& shared = *ring_.shared;
    // head before newest: a newest that is seen lies below the head that is seen after it.
    shared.head.store(head_, std::memory_order_release);
    shared.newest.store(start, std::memory_order_release);
    shared.sent.store(++sent_, std::memory_order_relaxed);
    shared.overwritten.store(overwritten_, std::memory_order_relaxed);
    shared.bytes_sent.store(bytes_ += used, std::memory_order_relaxed);
}

bool RingWriter::write(std::span<const std::byte> bytes, std::uint64_t stamp_ns, std::uint32_t tag) {
    const auto room = reserve(bytes.size());
    if (room.data() == nullptr) return false;
    if (!bytes.empty()) std::memcpy(room.data(), bytes.data(), bytes.size());
    const std::uint64_t before = refused_;
    commit(bytes.size(), stamp_ns, tag);
    return refused_ == before;
}

} // namespace tandem::shm
