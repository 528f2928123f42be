// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/clock.hpp"
#include "shm/ring/ring.hpp"
#include "shm/ring/ring_producer.hpp"

#include <memory>

namespace tandem::shm {

extern template class RingProducer<RealAtomics>;

/// [one thread] The writing end of a ring. Allocates nothing and makes no system call, but for the first message
/// and the first use of a chunk in a sparse segment. It does not ring the doorbell: the user does, once after a batch.
class RingWriter {
  public:
    /// Throws Error if this side is not the ring's writer, the ring is damaged, or it has chunks and another
    /// RingWriter has written to it.
    explicit RingWriter(RingHandle ring);

    /// Memory for a payload of up to `bytes`. data() == nullptr if there is none, which counts as one sent
    /// and dropped. Up to max_record bytes it never fails; commit() drops no more than the bytes used need.
    std::span<std::byte> reserve(std::size_t bytes);

    /// Publishes the first `used` bytes of what was reserved. False: dropped after all (ring damaged).
    bool commit(std::size_t used, std::uint64_t stamp_ns);
    void cancel_reservation() { producer_.cancel_reservation(); } ///< Forgets what was reserved, uncounted.

    /// Whether a message of that length can be published without dropping an older one.
    bool has_room(std::size_t bytes) { return producer_.has_room(bytes); }
    void refuse() { producer_.refuse(); } ///< Counts a message that could not be made, as sent and dropped.

    /// Where a message of up to max_record() bytes may be made for write(), 8-aligned. The payload_front bytes in front
    /// of it may be overwritten, too.
    std::span<std::byte> scratch() {
        return {reinterpret_cast<std::byte*>(scratch_.get()) + payload_front, ring_.view.max_record};
    }
    /// Publishes the first `used` bytes of scratch(). False: dropped.
    [[gnu::always_inline]] bool publish(std::size_t used, std::uint64_t stamp_ns) {
        if (producer_.write_behind_last(scratch().data(), used, stamp_ns, true)) [[likely]]
            return true;
        return write(scratch().first(used), stamp_ns);
    }
    /// Publishes a message of a word and `count` others that lie elsewhere, up to max_record() bytes, if that takes no detour.
    /// False: it does, and nothing has happened.
    [[gnu::always_inline]] bool try_publish_words(std::uint64_t first, const void* others, std::size_t count,
                                                  std::uint64_t stamp_ns) {
        return producer_.write_words_behind_last(first, others, count, stamp_ns);
    }
    /// reserve(), copy, commit(). False: dropped. A warm-up changes nothing and returns true.
    bool write(std::span<const std::byte> bytes, std::uint64_t stamp_ns, Pass pass = Pass::real);

    /// Has the age of the next message measured, beside those that are measured in any case.
    void sample_next() { producer_.sample_next(); }
    /// The same, but no more than once in 0.1 to 0.5 s, as the time-stamp counter counts them. For senders whose readers sleep,
    /// each message of which would go the longer way otherwise. Reads no clock.
    void sample_next_sometimes() {
        constexpr std::uint64_t pause = std::uint64_t{1} << 29; // ticks, of which 1e9 to 5e9 are a second
        const std::uint64_t ticks = time_stamp_counter();
        if (ticks - sampled_at_ticks_ < pause) return; // never true if the counter went back, on another core
        sampled_at_ticks_ = ticks;
        sample_next();
    }

    std::size_t max_record() const { return ring_.view.max_record; } ///< payload that needs no chunk, bytes
    std::size_t max_message() const { return producer_.max_message(); } ///< longest payload at all, bytes
    /// The shared words are impossible: nothing is sent any more.
    bool corrupt() const { return producer_.corrupt(); }
    RingCounters counters() const { return read_counters(ring_); }
    void count_converted() { count_one(ring_.view.shared->converted_by_writer); } ///< see RingCounters

  private:
    bool take_memory();

    RingHandle ring_;
    RingProducer<RealAtomics> producer_;
    std::unique_ptr<std::uint64_t[]>
        scratch_;                        // payloads up to max_record are made here, see ring_producer.hpp
    bool has_memory_;                    // the ring's data; in a sparse segment from the first message on
    std::uint64_t sampled_at_ticks_ = 0; // when sample_next_sometimes() last had an age measured
};

} // namespace tandem::shm
