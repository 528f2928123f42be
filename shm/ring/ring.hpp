// SPDX-License-Identifier: Apache-2.0
// Messages from one thread of one side to one thread of the other: variable length, in order, never blocking
// unless asked to. Always, for every policy: sent = received + dropped + waiting (RingCounters).
#pragma once
#include "shm/ring/ring_consumer.hpp"
#include "shm/ring/ring_producer.hpp"
#include "shm/segment/mapping.hpp"

#include <memory>

namespace tandem::shm {

extern template class RingProducer<RealAtomics>;
extern template class RingConsumer<RealAtomics>;

struct RingOptions {
    Side writer = Side::first;
    RingPolicy policy = RingPolicy::drop_oldest;
    std::size_t max_record = std::size_t{64} * 1024; ///< longest payload in the ring itself, bytes
    std::size_t capacity =
        256 * 1024; ///< bytes; rounded up to a power of two that holds two of the longest records
    std::chrono::nanoseconds wait = std::chrono::milliseconds(10); ///< of RingPolicy::wait; 10 s at most
    /// For payloads longer than max_record: written and read in place in one of that many chunks, of that
    /// many bytes. At least 2 of them, better 4: the reader holds one, the writer fills one, others wait.
    /// In a sparse segment, the first payload of such a length in a chunk costs system calls and memory; if
    /// there is none, it is refused.
    std::size_t chunk_bytes = 0;
    std::uint32_t chunks = 0;
};

/// A ring found or made by Segment.
struct RingHandle {
    std::shared_ptr<const Mapping> mapping;
    RingView<RealAtomics> view;
    Side writer;
};

/// dropped = refused (no room, too long) + overwritten (by the writer) + skipped (by the reader, for a newer
/// one). Read while both sides run, the counters are of slightly different moments; at rest they add up
/// exactly.
struct RingCounters {
    std::uint64_t sent, refused, overwritten, skipped, received, bytes_sent, bytes_received;
    std::uint64_t dropped() const { return refused + overwritten + skipped; }
    /// 0 also if less was counted as sent than is gone: the words are read one after the other, and a writer
    /// killed between a record and its count leaves one more received than sent.
    std::uint64_t waiting() const {
        const std::uint64_t gone = dropped() + received;
        return sent > gone ? sent - gone : 0;
    }
};
RingCounters read_counters(const RingHandle& ring); ///< [any-process] Costs the running system nothing.

/// [one thread] The writing end. No allocation, no system call (but RingPolicy::wait, when the ring is full).
/// Does not ring the doorbell: the user does, once after a batch.
class RingWriter {
  public:
    /// Throws Error if this side is not the ring's writer, the ring is damaged, or it has chunks and another
    /// RingWriter has written to it.
    explicit RingWriter(RingHandle ring);

    /// Room for a payload of up to `bytes`; data() == nullptr if there is none, which counts as one sent and
    /// dropped. In a lossy ring it fits (up to max_record), and commit() drops no more than what it really
    /// needs. Longer than max_record: in a chunk.
    std::span<std::byte> reserve(std::size_t bytes);

    /// Publishes the first `used` bytes of what was reserved. abandon(): forgets it instead, uncounted.
    /// False: dropped after all (ring damaged).
    bool commit(std::size_t used, std::uint64_t stamp_ns, std::uint8_t tag);
    void abandon() { producer_.abandon(); }

    /// reserve, copy, commit. False: dropped.
    bool write(std::span<const std::byte> bytes, std::uint64_t stamp_ns, std::uint8_t tag) {
        return producer_.write(bytes.data(), bytes.size(), stamp_ns, tag);
    }

    std::size_t in_ring() const { return ring_.view.max_record; } ///< payload that needs no chunk, bytes
    std::size_t longest() const { return producer_.longest(); }   ///< payload that ever fits, bytes
    bool corrupt() const {
        return producer_.corrupt();
    } ///< The shared words are impossible: nothing is sent any more.
    RingCounters counters() const { return read_counters(ring_); }

  private:
    RingHandle ring_;
    RingProducer<RealAtomics> producer_;
    std::vector<std::uint64_t> scratch_; // lossy only: see ring_producer.hpp
};

/// [one thread] The reading end. No allocation, no system call (but to wake a writer that waits for room).
class RingReader {
  public:
    /// Throws Error if this side is not the ring's reader, or the ring is damaged.
    explicit RingReader(RingHandle ring);

    /// True if there is nothing to read. No more than a look at lines that stay in this core's cache until
    /// the writer writes.
    bool empty() const { return consumer_.empty(); }

    /// The oldest record (of a latest_only ring: the newest), copied out; or, of a payload in a chunk, lent:
    /// the chunk goes back with the next one read. Empty: nothing there, corrupt(), or a lossy writer
    /// overtook every one of many tries; then the next read gets what it wrote.
    std::optional<Record> read() { return empty() ? std::nullopt : consumer_.read(); }
    std::optional<Record> read_newest() { ///< The newest; the older ones count as skipped.
        return empty() ? std::nullopt : consumer_.read_newest();
    }

    /// Without a copy, in rings that do not overwrite (reject, wait): the oldest record as it lies in shared
    /// memory, until release() takes it off the ring. Its bytes change if the other side is broken: check
    /// what you have read, not what you will read.
    std::optional<Record> peek();
    void release();

    /// Hands up to `most` records to use(const Record&), in order, as peek() does, and gives their room back
    /// at once; a lossy ring's are copied one by one. Returns how many there were.
    template <class Use>
    std::size_t consume(Use&& use, std::size_t most) {
        if (!ring_.view.lossy()) return consumer_.consume(use, most);
        std::size_t done = 0;
        for (; done < most; ++done) {
            const auto record = consumer_.read();
            if (!record) break;
            use(*record);
        }
        return done;
    }

    bool corrupt() const {
        return consumer_.corrupt();
    } ///< The shared words are impossible: nothing is received any more.
    RingCounters counters() const { return read_counters(ring_); }

  private:
    RingHandle ring_;
    RingConsumer<RealAtomics> consumer_;
};

// Used by Segment.
struct RingMemory {
    std::uint64_t all, at_once; ///< bytes; at once: without its chunks
};
RingMemory ring_memory(const std::string& name,
                       const RingOptions& options); ///< What it takes. Throws Error for bad options.
RingHandle create_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                       const RingOptions& options);
RingHandle open_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                     const std::string& name);

} // namespace tandem::shm
