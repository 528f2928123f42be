// SPDX-License-Identifier: Apache-2.0
// A minimal ring: one writer, one reader, and slots of one size. The index of each end is on a separate cache
// line, and each end caches the index of its peer. The ring has no policies, counters, checks or lengths;
// Tandem's ring is slower by the cost of these.
#pragma once
#include "apps/bench/harness/case.hpp"
#include "apps/bench/machine/clock.hpp"
#include "shm/os/processor.hpp"

#include <atomic>
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::bench {

/// At the front of the ring's memory, which is zero at first. Each word gets two cache lines, because the
/// prefetcher fetches lines in pairs.
struct IndexRingHeader {
    alignas(128) std::atomic<std::uint32_t> head; // messages published; written by the writer
    alignas(128) std::atomic<std::uint32_t> tail; // messages released; written by the reader
    alignas(128) std::atomic<std::uint32_t> reader_sleeps;
};

/// latency: each message arrives as early as possible. throughput: as many messages as possible arrive, so the
/// reader keeps off the head's line for a moment when the ring is empty, and returns slots 64 at a time.
enum class RingTuning { latency, throughput };

/// [one thread at each end] All options are template parameters, so that none of them costs anything at run
/// time. Both ends are created over the same memory; an object is used as the writer or as the reader, never as
/// both.
template <std::size_t slot_bytes, std::uint32_t slots, Wake wake, RingTuning tuning = RingTuning::latency>
class IndexRing {
  public:
    static constexpr std::size_t memory_bytes = sizeof(IndexRingHeader) + slot_bytes * slots;

    explicit IndexRing(std::byte* memory)
        : header_(*reinterpret_cast<IndexRingHeader*>(memory)), slots_(memory + sizeof(IndexRingHeader)) {}

    /// [writer] Returns the slot to be written next; polls while the ring is full.
    std::byte* claim() {
        while (own_index_ - peer_index_ >= slots) peer_index_ = header_.tail.load(std::memory_order_acquire);
        return slot(own_index_);
    }
    /// [writer] Hands the claimed slot to the reader, and wakes it if it sleeps.
    void publish() {
        header_.head.store(++own_index_, std::memory_order_release);
        if constexpr (wake == Wake::spin) return;
        // Orders the store of head before the load of reader_sleeps; the reader does the opposite in sleep().
        // Without both fences, each end could miss the store of the other, and the reader would sleep although
        // a message is there.
        std::atomic_thread_fence(std::memory_order_seq_cst);
        if (header_.reader_sleeps.load(std::memory_order_relaxed) != 0) futex(FUTEX_WAKE, 1);
    }

    /// [reader] Checks once.
    bool has_slot() { return peer_index_ != own_index_ || has_message(); }
    /// [reader] Returns the oldest slot; waits for it in the ring's wake mode.
    const std::byte* wait_for_slot() {
        if (peer_index_ == own_index_) peer_index_ = header_.head.load(std::memory_order_acquire);
        if (peer_index_ == own_index_) wait();
        return slot(own_index_);
    }
    /// [reader] Returns the oldest slot to the writer.
    void release() {
        if (++own_index_ % (tuning == RingTuning::throughput ? 64U : 1U) == 0)
            header_.tail.store(own_index_, std::memory_order_release);
    }

  private:
    // Otherwise the last slots of a full ring would never be returned.
    static_assert(slots % 64 == 0 || tuning == RingTuning::latency);

    std::byte* slot(std::uint32_t index) const { return slots_ + (index % slots) * slot_bytes; }
    /// Prefetches the slot's line together with the head's, so that the two transfers overlap: 160 ns instead
    /// of 240.
    bool has_message() {
        peer_index_ = header_.head.load(std::memory_order_acquire);
        if (peer_index_ != own_index_) return true;
        if (tuning == RingTuning::throughput)
            shm::Processor::pause();
        else
            __builtin_prefetch(slot(own_index_));
        return false;
    }
    void wait() {
        if (wake == Wake::spin) {
            while (!has_message()) {
            }
        } else if (wake == Wake::blocking || !spin_50_us()) {
            sleep();
        }
    }
    bool spin_50_us() {
        const std::uint64_t end = ticks() + to_ticks(50e3);
        for (unsigned round = 1; !has_message(); ++round) {
            if (round % 64 == 0 && ticks() > end) return false;
        }
        return true;
    }
    void sleep() {
        for (;;) {
            header_.reader_sleeps.store(1, std::memory_order_relaxed);
            std::atomic_thread_fence(std::memory_order_seq_cst); // see publish()
            if (has_message()) break;
            futex(FUTEX_WAIT, own_index_); // returns at once if head has changed since has_message()
            if (has_message()) break;
        }
        header_.reader_sleeps.store(0, std::memory_order_relaxed);
    }
    void futex(int operation, std::uint32_t value) {
        syscall(SYS_futex, &header_.head, operation, value, nullptr, nullptr, 0);
    }

    IndexRingHeader& header_;
    std::byte* slots_;
    std::uint32_t own_index_ = 0;  // of the next slot of this end
    std::uint32_t peer_index_ = 0; // the peer's index when it was last read
};

} // namespace tandem::bench
