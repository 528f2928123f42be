// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/ring/ring.hpp"
#include "shm/ring/ring_consumer.hpp"

namespace tandem::shm {

extern template class RingConsumer<RealAtomics>;

/// [one thread] The reading end of a ring. Allocates nothing and makes no system call.
class RingReader {
  public:
    /// Throws Error if this side is not the ring's reader, or the ring is damaged.
    explicit RingReader(RingHandle ring);

    /// True if there is nothing to read. Looks only at lines that stay in this core's cache until the writer
    /// writes.
    bool empty() const { return consumer_.empty(); }

    /// The oldest record within the depth, copied out; a payload in a chunk is handed out in place, and the chunk goes back
    /// with the next record that is read. nullptr: nothing there, corrupt(), or the writer overtook every one
    /// of many attempts; then the next read gets what it wrote.
    [[gnu::always_inline]] const Record* read() { return consumer_.read(); }

    /// The newest record; the older ones count as skipped.
    const Record* read_newest() { return consumer_.read_newest(); }

    /// Of the records that wait, read() skips all but the `records` newest, as if the others had been overwritten; 0: none.
    void set_depth(std::uint64_t records) { consumer_.set_depth(records); }

    /// The record read last, once more; valid until the next one is read. nullptr if there is none.
    const Record* again() const { return consumer_.again(); }
    /// The same for a warm-up, with what the next read needs brought into the caches. nullptr if it was long, or
    /// there is none.
    const Record* last() { return consumer_.last(); }

    /// The shared words are impossible: nothing is received any more.
    bool corrupt() const { return consumer_.corrupt(); }
    RingCounters counters() const { return read_counters(ring_); }
    /// counters().sent, without the others.
    std::uint64_t sent() const { return ring_.view.shared->sent.load(std::memory_order_relaxed); }
    /// counters().waiting(), without the others.
    std::uint64_t waiting() const {
        constexpr auto relaxed = std::memory_order_relaxed;
        const auto& shared = *ring_.view.shared;
        RingCounters counters{};
        counters.sent = shared.sent.load(relaxed);
        counters.refused = shared.refused.load(relaxed);
        counters.overwritten = shared.overwritten.load(relaxed);
        counters.skipped = shared.skipped.load(relaxed);
        counters.received = shared.received.load(relaxed);
        const std::uint64_t waiting = counters.waiting(), depth = consumer_.depth();
        return depth != 0 && waiting > depth ? depth : waiting;
    }

    // For the counters of the ring's users: see RingCounters.
    void count_converted() { count_one(ring_.view.shared->converted_by_reader); }
    void count_undecodable() { count_one(ring_.view.shared->undecodable); }
    void count_missed_deadline() { count_one(ring_.view.shared->missed_deadlines); }

  private:
    RingHandle ring_;
    RingConsumer<RealAtomics> consumer_;
};

} // namespace tandem::shm
