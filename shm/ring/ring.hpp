// SPDX-License-Identifier: Apache-2.0
// A ring carries messages of variable length from one thread of one side to one thread of the other side, in order. It
// never blocks: when it is full, it drops the oldest messages. The counters are exact: sent = received + dropped + waiting
// (RingCounters).
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
    /// Size of each of `chunks` chunks, bytes. Payloads longer than max_record are written and read in place in a chunk. At
    /// least 2 chunks, better 4: the reader holds one, the writer fills one, the others wait. In a sparse segment a chunk
    /// gets its memory at first use; if there is none, the message is refused.
    std::size_t chunk_bytes = 0;
    std::uint32_t chunks = 0;
};

/// The sizes at the beginning of a RingHeader, in the same order.
struct RingSizes {
    std::uint64_t capacity, max_record, chunk_bytes;
    std::uint32_t chunks, writer;

    bool valid()
        const; ///< Returns whether a ring can have these sizes. Within their limits no sum of them overflows.
};

/// Returns the number of bytes that a ring takes in an arena; 0 for sizes that no ring has.
std::uint64_t ring_bytes(const RingSizes& sizes);

/// A ring that Segment has found or created. RingWriter and RingReader are constructed from it.
struct RingHandle {
    std::shared_ptr<const Mapping> mapping;
    RingView<RealAtomics> view;
    Side writer;
};

/// dropped = refused (too long, or no chunk available) + overwritten (by the writer) + skipped (by the reader, for a newer
/// record or because of its depth, even before the reader has skipped it). Counters that are read while both sides run
/// belong to slightly different moments. At rest they add up exactly.
struct RingCounters {
    std::uint64_t sent, refused, overwritten, skipped, received, bytes_sent, bytes_received;
    // The users of the ring count these: messages converted before writing or after reading, messages received that could
    // not be decoded, and missed deadlines of the next message.
    std::uint64_t converted, undecodable, missed_deadlines;
    /// Received messages for which the queue of a user of the reader had no room; one that several users miss counts for each.
    std::uint64_t discarded = 0;
    std::uint64_t depth = 0; ///< the reader wants only this many of the newest waiting records; 0: all
    std::uint64_t dropped() const { return refused + overwritten + skipped; }
    /// Returns the drops of wanted messages: a reader that reads more than the newest message loses what it skips.
    std::uint64_t lost() const { return refused + overwritten + discarded + (depth > 1 ? skipped : 0); }
    /// Returns 0 also if more messages are counted as gone than as sent: the words are read one after the other, and a
    /// writer killed between a record and its count leaves one more received than sent.
    std::uint64_t waiting() const {
        const std::uint64_t gone = dropped() + received;
        return sent > gone ? sent - gone : 0;
    }
    /// Counts waiting messages that are not within the depth as skipped.
    void skip_beyond_depth() {
        const std::uint64_t waits = waiting();
        if (depth != 0 && waits > depth) skipped += waits - depth;
    }
};
RingCounters read_counters(
    const RingHandle& ring); ///< [any-process] Reads the counters without disturbing the running system.

// Used by Segment.

/// The memory of a ring in an arena, bytes. without_chunks: the header and the records. idle: needed before the first
/// message. Throws Error for invalid options.
struct RingMemory {
    std::uint64_t total, without_chunks, idle;
};
RingMemory ring_memory(const std::string& name, const RingOptions& options);

/// Gives the records of a sparse segment their memory, before the first message. Returns false if /dev/shm is full.
bool give_memory(const RingHandle& ring);

RingHandle create_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                       const RingOptions& options);
/// Opens a ring in memory that the peer may have written. Throws Error if it does not hold a valid ring.
RingHandle open_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                     const std::string& name);

} // namespace tandem::shm
