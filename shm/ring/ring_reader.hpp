// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/ring/ring.hpp"
#include "shm/ring/ring_consumer.hpp"

#include <optional>

namespace tandem::shm {

extern template class RingConsumer<RealAtomics>;

/// [one thread] The reading end of a ring. Allocates nothing and makes no system call.
class RingReader {
  public:
    /// Throws Error if this side is not the ring's reader, or the ring is damaged.
    explicit RingReader(RingHandle ring);

    /// Returns true if there is nothing to read. Reads only lines that stay in this core's cache until the writer writes.
    bool empty() const { return consumer_.empty(); }

    /// Returns a copy of the oldest record within the depth. A payload in a chunk is not copied, and the chunk goes back
    /// with the next read. Returns nullptr if there is nothing, if the ring is corrupt(), or if the writer overtook each of
    /// many attempts; the next read then returns what the writer wrote.
    const Record* read() { return consumer_.read(); }

    /// Returns the newest record; the older ones count as skipped.
    const Record* read_newest() { return consumer_.read_newest(); }

    /// Makes read() skip all waiting records except the newest `records`, as if they had been overwritten; 0: none.
    void set_depth(std::uint64_t records) { consumer_.set_depth(records); }

    /// For a reader with several users: publishes how many records may wait so that no user's queue loses any; nothing: the
    /// depth says it. To take a record off the ring for other users, publish what is left for them before read().
    void set_room(std::optional<std::uint64_t> records) {
        ring_.view.shared->room.store(records ? *records + 1 : 0, std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_release); // before the counters of the next read()
    }
    /// Returns true if the sender holds messages back while there is no room for them.
    bool writer_waits_for_room() const {
        return ring_.view.shared->waits_for_room.load(std::memory_order_relaxed) != 0;
    }

    /// Returns the last record once more; valid until the next read. Returns nullptr if there is none.
    const Record* again() const { return consumer_.again(); }
    /// Returns the last record once more and loads what the next read() needs into the caches. Returns nullptr if the last
    /// record was long or there is none.
    const Record* rehearse_read() { return consumer_.rehearse_read(); }

    /// Returns true if the shared words are invalid: nothing more is received.
    bool corrupt() const { return consumer_.corrupt(); }
    RingCounters counters() const { return read_counters(ring_); }
    /// Returns counters().sent without reading the other counters.
    std::uint64_t sent() const { return ring_.view.shared->sent.load(std::memory_order_relaxed); }
    /// Returns counters().waiting() without reading the other counters.
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
    void count_discarded() { count_one(ring_.view.shared->discarded); }
    void count_missed_deadline() { count_one(ring_.view.shared->missed_deadlines); }

  private:
    RingHandle ring_;
    RingConsumer<RealAtomics> consumer_;
};

} // namespace tandem::shm
