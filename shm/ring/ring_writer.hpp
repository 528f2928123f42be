// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/clock.hpp"
#include "shm/ring/ring.hpp"
#include "shm/ring/ring_producer.hpp"

#include <memory>
#include <optional>

namespace tandem::shm {

extern template class RingProducer<RealAtomics>;

/// [one thread] The writing end of a ring. Allocates nothing and makes no system call, except, in a sparse segment, for the
/// first message and the first use of a chunk. Does not ring the doorbell: the user rings it once after a batch.
class RingWriter {
  public:
    /// Throws Error if this side is not the ring's writer, if the ring is damaged, or if it has chunks and another
    /// RingWriter has written to it.
    explicit RingWriter(RingHandle ring);

    /// Returns memory for a payload of up to `bytes`, or data() == nullptr, which counts as one message sent and dropped.
    /// Never fails up to max_record bytes; commit() drops only as many old messages as the used bytes require.
    std::span<std::byte> reserve(std::size_t bytes);

    /// Publishes the first `used` bytes of the reservation. Returns false if the message is dropped because the ring is
    /// damaged.
    bool commit(std::size_t used, std::uint64_t stamp_ns);
    void cancel_reservation() { producer_.cancel_reservation(); } ///< Forgets what was reserved, uncounted.

    /// Returns whether a message of this length can be published without dropping an older one.
    bool has_room(std::size_t bytes) { return producer_.has_room(bytes); }
    void refuse() { producer_.refuse(); } ///< Counts a message that could not be created as sent and dropped.

    /// Returns memory in which to create a message of up to max_record() bytes for write() or publish(), 8-aligned. The
    /// payload_front bytes before it may be overwritten, too.
    std::span<std::byte> scratch() {
        return {reinterpret_cast<std::byte*>(scratch_.get()) + payload_front, ring_.view.max_record};
    }
    /// Publishes the first `used` bytes of scratch(). Returns false if the message is dropped.
    bool publish(std::size_t used, std::uint64_t stamp_ns) {
        if (producer_.write_behind_last(scratch().data(), used, stamp_ns, true)) [[likely]]
            return true;
        return write(scratch().first(used), stamp_ns);
    }
    /// Publishes a message of one word and `count` other bytes at another address, up to max_record() bytes, if the fast
    /// path applies. Otherwise returns false without side effects.
    bool try_publish_words(std::uint64_t first, const void* others, std::size_t count,
                           std::uint64_t stamp_ns) {
        return producer_.write_words_behind_last(first, others, count, stamp_ns);
    }
    /// Performs reserve(), a copy and commit(). Returns false if the message is dropped.
    bool write(std::span<const std::byte> bytes, std::uint64_t stamp_ns);
    /// Loads what publish() of this length needs into the caches. Publishes nothing.
    void rehearse_publish(std::size_t used);

    /// Returns counters().sent without reading shared memory.
    std::uint64_t sent() const { return producer_.sent(); }

    /// Makes the writer measure the age of the next message, in addition to the regular samples.
    void sample_next() { producer_.sample_next(); }
    /// Calls sample_next() at most once in 0.1 to 0.5 s, by the processor's counter; reads no clock. For senders whose
    /// readers sleep: otherwise each message would take the longer path.
    void sample_next_sometimes() {
        constexpr std::uint64_t pause_ns = std::uint64_t{1} << 29; // of the slowest counter
        const std::uint64_t ticks = Processor::counter();
        // Never true if the counter went back on another core.
        if (ticks - sampled_at_ticks_ < ticks_within(pause_ns)) return;
        sampled_at_ticks_ = ticks;
        sample_next();
    }

    std::size_t max_record() const {
        return ring_.view.max_record;
    } ///< longest payload without a chunk, bytes
    std::size_t max_message() const {
        return producer_.max_message();
    } ///< longest payload with a chunk, bytes
    /// Returns true if the shared words are invalid: nothing more is sent.
    bool corrupt() const { return producer_.corrupt(); }
    RingCounters counters() const { return read_counters(ring_); }
    /// Tells the reader whether the user of this end holds messages back while there is no room for them.
    void set_waits_for_room(bool waits) {
        ring_.view.shared->waits_for_room.store(waits ? 1 : 0, std::memory_order_relaxed);
    }
    /// Returns how many records may wait, as published by RingReader::set_room(); nothing if the depth determines it.
    /// Call it after counters(): a record that the reader hands to its users meanwhile then counts twice rather than never.
    std::optional<std::uint64_t> published_room() const {
        std::atomic_thread_fence(std::memory_order_acquire);
        const std::uint64_t room = ring_.view.shared->room.load(std::memory_order_relaxed);
        return room == 0 ? std::nullopt : std::optional(room - 1);
    }
    void count_converted() { count_one(ring_.view.shared->converted_by_writer); } ///< see RingCounters

  private:
    bool take_memory();

    RingHandle ring_;
    RingProducer<RealAtomics> producer_;
    std::unique_ptr<std::uint64_t[]> scratch_; // payloads up to max_record, see ring_producer.hpp
    bool has_memory_; // the ring's data; in a sparse segment true from the first message on
    std::uint64_t sampled_at_ticks_ = 0; // when sample_next_sometimes() last called sample_next()
};

} // namespace tandem::shm
