// SPDX-License-Identifier: Apache-2.0
// Nothing that stands in the ring is believed before it was checked against this process's own copy of the
// sizes, and nothing is used before it was copied. In a lossy ring a look may find the bytes of a record that
// is being overwritten. Such a look is not evidence of damage: only if the words that would have had to move
// have not moved, the bytes are impossible and the ring is given up.
#include "shm/error.hpp"
#include "shm/futex.hpp"
#include "shm/ring.hpp"
#include "shm/shared_copy.hpp"

namespace tandem::shm {
namespace {

// How often a lossy writer may overtake one read. Each time it has put a whole ring's worth of records in
// the time of one copy.
constexpr int overtakings = 64;

} // namespace

RingReader::RingReader(RingHandle ring) : ring_(std::move(ring)) {
    if (ring_.writer == ring_.mapping->side())
        throw Error(ring_.mapping->path() + ": a ring written by side " + name_of(ring_.writer) +
                    " cannot be read here; use RingWriter");
    auto& shared = *ring_.shared;
    tail_ = shared.tail.load(std::memory_order_acquire);
    received_ = shared.received.load(std::memory_order_relaxed);
    skipped_ = shared.skipped.load(std::memory_order_relaxed);
    bytes_ = shared.bytes_received.load(std::memory_order_relaxed);
    if (tail_ % word_bytes != 0)
        throw Error(ring_.mapping->path() +
                    ": a ring to be read is damaged; leave the segment and join again");
    scratch_.resize(std::max<std::uint64_t>(round_up(ring_.max_record, word_bytes) / word_bytes, 1));
}

// In a lossless ring nobody else moves the tail: my copy is the truth.
std::uint64_t RingReader::current_tail() const {
    return ring_.lossy() ? ring_.shared->tail.load(std::memory_order_acquire) : tail_;
}

/// The record at `at` (or behind the padding there), if that can be one between `at` and `head`.
std::optional<RingReader::Found> RingReader::look(std::uint64_t at, std::uint64_t head) const {
    if (at < tail_ || at >= head || head - at > ring_.capacity || at % word_bytes != 0) return std::nullopt;
    const std::uint64_t mask = ring_.capacity - 1;
    std::uint64_t first = load_word(ring_.data + (at & mask));
    if (static_cast<std::uint32_t>(first) == layout::padding_length) {
        at += ring_.capacity - (at & mask);
        if (at >= head) return std::nullopt;
        first = load_word(ring_.data);
    }
    const auto length = static_cast<std::uint32_t>(first);
    const std::uint64_t bytes = record_bytes(length);
    const std::uint64_t to_end = ring_.capacity - (at & mask);
    if (length > ring_.max_record || bytes > to_end || bytes > head - at) return std::nullopt;
    const std::byte* record = ring_.data + (at & mask);
    return Found{at,
                 at + bytes,
                 load_word(record + offsetof(layout::RecordHeader, sequence)),
                 load_word(record + offsetof(layout::RecordHeader, stamp_ns)),
                 length,
                 static_cast<std::uint32_t>(first >> 32U)};
}

void RingReader::copy(const Found& found) {
    const std::byte* payload =
        ring_.data + (found.start & (ring_.capacity - 1)) + sizeof(layout::RecordHeader);
    copy_from_shared(scratch_.data(), payload, found.length);
}

/// Takes [from, to). False: the writer was faster, `from` is the tail now. seq_cst for the writer that waits
/// for room: it announces its sleep and looks at the tail, this moves the tail and looks for the announcement
/// (futex.hpp).
bool RingReader::move_tail(std::uint64_t& from, std::uint64_t to) {
    auto& tail = ring_.shared->tail;
    if (ring_.lossy()) {
        if (!tail.compare_exchange_strong(from, to, std::memory_order_acq_rel, std::memory_order_acquire))
            return false;
    } else if (ring_.policy == RingPolicy::wait) {
        tail.store(to, std::memory_order_seq_cst);
        wake(ring_.shared->writer_sleeps);
    } else {
        tail.store(to, std::memory_order_release);
    }
    tail_ = to;
    return true;
}

Record RingReader::deliver(const Found& found, std::uint64_t skipped) {
    auto& shared = *ring_.shared;
    shared.received.store(++received_, std::memory_order_relaxed);
    shared.skipped.store(skipped_ += skipped, std::memory_order_relaxed);
    shared.bytes_received.store(bytes_ += found.length, std::memory_order_relaxed);
    return {{reinterpret_cast<const std::byte*>(scratch_.data()), found.length},
            found.sequence,
            found.stamp_ns,
            found.tag};
}

std::optional<Record> RingReader::read() {
    if (corrupt_ || empty()) return std::nullopt;
    return ring_.policy == RingPolicy::latest_only ? read_newest() : read_oldest();
}

// tail is loaded before head. If it is still the same afterwards, the writer had not moved it when it stored
// that head (it moves the tail first), so the record at tail was whole: a look that fails then has found
// damage.
std::optional<Record> RingReader::read_oldest() {
    for (int i = 0; i < overtakings; ++i) {
        std::uint64_t tail = current_tail();
        const std::uint64_t head = ring_.shared->head.load(std::memory_order_acquire);
        if (head == tail) return std::nullopt;
        const auto found = look(tail, head);
        if (!found) {
            if (current_tail() != tail) continue;
            corrupt_ = true;
            return std::nullopt;
        }
        copy(*found);
        if (move_tail(tail, found->end)) return deliver(*found, 0);
    }
    return std::nullopt;
}

/// Moves the tail from wherever it is to behind `newest`, and says how many older records that skips. The
/// copy made before is whole as long as the tail has not passed the record's begin. Empty: it has.
std::optional<std::uint64_t> RingReader::take_up_to(const Found& newest, std::uint64_t tail,
                                                    std::uint64_t head) {
    for (int i = 0; i < overtakings && tail <= newest.start; ++i) {
        const auto oldest = look(tail, head);
        if (oldest && move_tail(tail, newest.end)) return newest.sequence - oldest->sequence;
        if (oldest) continue; // move_tail() has set `tail` anew
        corrupt_ = current_tail() == tail;
        if (corrupt_) break;
        tail = current_tail();
    }
    return std::nullopt;
}

// The writer stores head, then newest; this loads newest, then head: so the record at newest lies below that
// head. It may be the last but one, for a moment or (writer killed between the two stores) for ever; if that
// one has been taken already, newest lies below tail, and the record at tail is the newest there is. A look
// that fails has found damage only if neither tail nor newest has moved since.
std::optional<Record> RingReader::read_newest() {
    if (corrupt_ || empty()) return std::nullopt;
    for (int i = 0; i < overtakings && !corrupt_; ++i) {
        const std::uint64_t tail = current_tail();
        const std::uint64_t newest = ring_.shared->newest.load(std::memory_order_acquire);
        const std::uint64_t head = ring_.shared->head.load(std::memory_order_acquire);
        if (head == tail) return std::nullopt;
        if (const auto found = look(std::max(newest, tail), head)) {
            copy(*found);
            if (const auto skipped = take_up_to(*found, tail, head)) return deliver(*found, *skipped);
        } else {
            const bool moved =
                current_tail() != tail || ring_.shared->newest.load(std::memory_order_acquire) != newest;
            corrupt_ = !moved;
        }
    }
    return std::nullopt;
}

} // namespace tandem::shm
