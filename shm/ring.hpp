// SPDX-License-Identifier: Apache-2.0
// Messages from one thread of one side to one thread of the other: variable length, in order, never blocking
// unless asked to. Always, for every policy: sent = received + dropped + waiting.
#pragma once
#include "shm/mapping.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace tandem::shm {

/// What happens when the reader is slower than the writer.
/// latest_only: the reader gets the newest, everything older is dropped. drop_oldest: the oldest make room.
/// reject: the new one is dropped. wait: the writer waits up to RingOptions::wait, then the new one is
/// dropped.
enum class RingPolicy : std::uint32_t { latest_only, drop_oldest, reject, wait };

struct RingOptions {
    Side writer = Side::first;
    RingPolicy policy = RingPolicy::drop_oldest;
    std::size_t max_record = std::size_t{64} * 1024; ///< longest payload, bytes
    std::size_t capacity =
        256 * 1024; ///< bytes; rounded up to a power of two that holds two of the longest records
    std::chrono::nanoseconds wait = std::chrono::milliseconds(10); ///< of RingPolicy::wait; 10 s at most
};

/// A ring found or made by Segment: its place, and this process's own copy of its sizes.
struct RingHandle {
    std::shared_ptr<const Mapping> mapping;
    layout::RingHeader* shared;
    std::byte* data;
    std::uint64_t capacity, max_record, wait_ns;
    RingPolicy policy;
    Side writer;
    bool lossy() const { return policy == RingPolicy::latest_only || policy == RingPolicy::drop_oldest; }
};

/// dropped = refused (no room, too long) + overwritten (by the writer) + skipped (by the reader, for a newer
/// one). Read while both sides run, the counters are of slightly different moments; at rest they add up
/// exactly.
struct RingCounters {
    std::uint64_t sent, refused, overwritten, skipped, received, bytes_sent, bytes_received;
    std::uint64_t dropped() const { return refused + overwritten + skipped; }
    std::uint64_t waiting() const { return sent - dropped() - received; }
};
RingCounters read_counters(const RingHandle& ring); ///< [any-process] Costs the running system nothing.

/// A received message; valid until the next read of the same reader, whatever the writer does.
struct Record {
    std::span<const std::byte> bytes; ///< 8-aligned
    std::uint64_t sequence;           ///< 1, 2, 3 ...; a gap is a drop after acceptance
    std::uint64_t stamp_ns;
    std::uint32_t tag;
};

/// [one thread] The writing end. No allocation, no system call (but RingPolicy::wait, when the ring is full).
/// Does not ring the doorbell: the user does, once after a batch.
class RingWriter {
  public:
    /// Throws Error if this side is not the ring's writer, or the ring is damaged.
    explicit RingWriter(RingHandle ring);

    /// Room for a payload of up to `bytes`; data() == nullptr if there is none, which counts as one sent and
    /// dropped. In a lossy ring it always fits (up to max_record), and commit() drops no more than what it
    /// really needs.
    std::span<std::byte> reserve(std::size_t bytes);

    /// Publishes the first `used` bytes of what was reserved. abandon(): forgets it instead, uncounted.
    void commit(std::size_t used, std::uint64_t stamp_ns, std::uint32_t tag);
    void abandon() { reserved_ = nothing; }

    /// reserve, copy, commit. False: dropped.
    bool write(std::span<const std::byte> bytes, std::uint64_t stamp_ns, std::uint32_t tag);

    bool corrupt() const { return corrupt_; } ///< The shared words are impossible: nothing is sent any more.
    RingCounters counters() const { return read_counters(ring_); }

  private:
    static constexpr std::uint64_t nothing = ~std::uint64_t{0};

    std::uint64_t padding_before(std::uint64_t record) const;
    bool plausible(std::uint64_t tail) const;
    bool fits(std::uint64_t need);
    bool wait_for_room(std::uint64_t need);
    bool drop_until_fits(std::uint64_t need);
    void refuse();
    void publish(std::uint64_t start, std::size_t used, std::uint64_t stamp_ns, std::uint32_t tag);

    RingHandle ring_;
    std::uint64_t head_, tail_; // head is mine; tail as last seen
    std::uint64_t sequence_;    // of the newest record
    std::uint64_t reserved_ = nothing;
    std::uint64_t sent_, refused_, overwritten_, bytes_;
    std::vector<std::uint64_t> scratch_; // lossy only: see ring_writer.cpp
    bool corrupt_ = false;
};

/// [one thread] The reading end. No allocation, no system call (but to wake a writer that waits for room).
class RingReader {
  public:
    /// Throws Error if this side is not the ring's reader, or the ring is damaged.
    explicit RingReader(RingHandle ring);

    /// True if there is nothing to read: one load of a line that stays in this core's cache until the writer
    /// writes.
    bool empty() const { return ring_.shared->head.load(std::memory_order_acquire) == tail_; }

    /// The oldest record (of a latest_only ring: the newest). Empty: nothing there, corrupt(), or a lossy
    /// writer overtook every one of many tries; then the next read gets what it wrote.
    std::optional<Record> read();
    std::optional<Record> read_newest(); ///< The newest; the older ones count as skipped.

    bool corrupt() const {
        return corrupt_;
    } ///< The shared words are impossible: nothing is received any more.
    RingCounters counters() const { return read_counters(ring_); }

  private:
    struct Found {
        std::uint64_t start, end, sequence, stamp_ns;
        std::uint32_t length, tag;
    };

    std::uint64_t current_tail() const;
    std::optional<Found> look(std::uint64_t at, std::uint64_t head) const;
    std::optional<Record> read_oldest();
    bool move_tail(std::uint64_t& from, std::uint64_t to);
    std::optional<std::uint64_t> take_up_to(const Found& newest, std::uint64_t tail, std::uint64_t head);
    void copy(const Found& found);
    Record deliver(const Found& found, std::uint64_t skipped);

    RingHandle ring_;
    std::uint64_t tail_; // end of what I consumed last; in lossy rings the shared one may be further
    std::uint64_t received_, skipped_, bytes_;
    std::vector<std::uint64_t> scratch_;
    bool corrupt_ = false;
};

// Used by Segment.
std::uint64_t ring_capacity(const std::string& name,
                            const RingOptions& options); ///< Throws Error for bad options.
RingHandle create_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                       const RingOptions& options);
RingHandle open_ring(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                     const std::string& name);

constexpr std::uint64_t record_bytes(std::uint64_t payload) {
    return (sizeof(layout::RecordHeader) + payload + 7) & ~std::uint64_t{7};
}

} // namespace tandem::shm
