// SPDX-License-Identifier: Apache-2.0
// A ring carries messages of variable length from one thread of one side to one thread of the other, in
// order. It never blocks: when it is full, the oldest messages make room for the new one. Counted exactly:
// sent = received + dropped + waiting (RingCounters).
#pragma once
#include "shm/ring/ring_view.hpp"
#include "shm/segment/mapping.hpp"

#include <memory>
#include <span>
#include <string>

namespace tandem::shm {

struct RingOptions {
    Side writer = Side::first;
    std::size_t max_record = std::size_t{64} * 1024; ///< longest payload in the ring itself, bytes
    /// Bytes; rounded up to a power of two that holds two of the longest records.
    std::size_t capacity = std::size_t{256} * 1024;
    /// Payloads longer than max_record are written and read in place, in one of `chunks` chunks of this many
    /// bytes. At least 2 chunks, better 4: the reader holds one, the writer fills one, the others wait. In a
    /// sparse segment a chunk is given memory when it is first used; if there is none, the message is
    /// refused.
    std::size_t chunk_bytes = 0;
    std::uint32_t chunks = 0;
};

/// A ring found or made by Segment, to make a RingWriter or a RingReader from.
struct RingHandle {
    std::shared_ptr<const Mapping> mapping;
    RingView<RealAtomics> view;
    Side writer;
};

/// dropped = refused (too long, or no chunk for it) + overwritten (by the writer) + skipped (by the reader,
/// for a newer one, or because it is not within its depth: also if the reader has not come to skip it yet). Read while both sides run, the counters are of slightly different moments; at rest they
/// add up exactly.
struct RingCounters {
    std::uint64_t sent, refused, overwritten, skipped, received, bytes_sent, bytes_received;
    // Counted by those who use the ring: messages that were converted before they were written or after they were read,
    // messages that were received and could not be decoded, and times at which the next one did not come in time.
    std::uint64_t converted, undecodable, missed_deadlines;
    std::uint64_t depth = 0; ///< of what waits the reader wants so many, the newest; 0: all
    std::uint64_t dropped() const { return refused + overwritten + skipped; }
    /// Those that were wanted: a reader that looks back further than to the newest one skips what comes too fast for it.
    std::uint64_t lost() const { return refused + overwritten + (depth > 1 ? skipped : 0); }
    /// 0 also if more is counted as gone than as sent: the words are read one after the other, and a writer
    /// killed between a record and its count leaves one more received than sent.
    std::uint64_t waiting() const {
        const std::uint64_t gone = dropped() + received;
        return sent > gone ? sent - gone : 0;
    }
    /// Counts what waits and is not within the depth as skipped.
    void skip_beyond_depth() {
        const std::uint64_t waits = waiting();
        if (depth != 0 && waits > depth) skipped += waits - depth;
    }
};
RingCounters read_counters(const RingHandle& ring); ///< [any-process] Costs the running system nothing.

// Used by Segment.

/// Bytes that a ring takes in an arena. without_chunks: those of the header and the records. idle: those that it
/// needs before the first message. Throws Error for options that no ring can have.
struct RingMemory {
    std::uint64_t total, without_chunks, idle;
};
RingMemory ring_memory(const std::string& name, const RingOptions& options);

/// In a sparse segment, before the first message: gives the records their memory. False: /dev/shm has none left.
bool give_memory(const RingHandle& ring);

RingHandle create_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                       const RingOptions& options);
/// Throws Error if the memory, which the peer may have written, does not hold a sound ring.
RingHandle open_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                     const std::string& name);

} // namespace tandem::shm
