// SPDX-License-Identifier: Apache-2.0
// The floor of every ring: one writer, one reader, fixed slots, an index on a line of its own at each end,
// the other side's index cached. No policies, no counters, no checks, no lengths: what remains when all that
// makes a ring usable is left out.
#pragma once
#include "apps/bench/harness/measurements.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::bench {

/// At the front of the ring's memory. Two lines each, because the core fetches lines in pairs.
struct IndexRingHeader {
    alignas(128) std::atomic<std::uint32_t> head; // written by the writer
    alignas(128) std::atomic<std::uint32_t> tail; // written by the reader
    alignas(128) std::atomic<std::uint32_t> asleep;
};

/// latency: each message as early as possible. rate: as many as possible, so that the reader stays off the
/// head line for a moment when it has caught up, and gives slots back by the batch.
enum class RingTuning { latency, throughput };

/// Everything that can be known at compile time is: the floor has no knobs.
template <std::size_t slot_bytes, std::uint32_t slots, Wake wake, RingTuning tuning = RingTuning::latency>
class IndexRing {
  public:
    static constexpr std::size_t memory_bytes = sizeof(IndexRingHeader) + slot_bytes * slots;

    explicit IndexRing(std::byte* memory)
        : words_(*reinterpret_cast<IndexRingHeader*>(memory)), slots_(memory + sizeof(IndexRingHeader)) {}

    /// The slot to be written next; waits for it if the ring is full.
    std::byte* claim() {
        while (mine_ - other_ >= slots) other_ = words_.tail.load(std::memory_order_acquire);
        return slot(mine_);
    }
    void publish() {
        words_.head.store(++mine_, std::memory_order_release);
        if constexpr (wake == Wake::spin) return;
        // Orders the store of head before the load of asleep: see sleep().
        std::atomic_thread_fence(std::memory_order_seq_cst);
        if (words_.asleep.load(std::memory_order_relaxed) != 0) futex(FUTEX_WAKE, 1);
    }

    /// The slot to be read next; waits for it in the ring's wake mode.
    const std::byte* next() {
        if (other_ == mine_) other_ = words_.head.load(std::memory_order_acquire);
        if (other_ == mine_) wait();
        return slot(mine_);
    }
    void release() {
        if (++mine_ % (tuning == RingTuning::throughput ? 64U : 1U) == 0)
            words_.tail.store(mine_, std::memory_order_release);
    }

  private:
    static_assert(slots % 64 == 0 || tuning == RingTuning::latency);

    std::byte* slot(std::uint32_t index) const { return slots_ + (index % slots) * slot_bytes; }
    /// Asking for the slot's line along with the head's lets the two transfers overlap: 160 ns instead of
    /// 240.
    bool arrived() {
        other_ = words_.head.load(std::memory_order_acquire);
        if (other_ != mine_) return true;
        if (tuning == RingTuning::throughput)
            _mm_pause();
        else
            __builtin_prefetch(slot(mine_));
        return false;
    }
    void wait() {
        if (wake == Wake::spin) {
            while (!arrived()) {
            }
        } else if (wake == Wake::blocking || !spin_50_us()) {
            sleep();
        }
    }
    bool spin_50_us() {
        const std::uint64_t end = ticks() + to_ticks(50e3);
        for (unsigned round = 1; !arrived(); ++round) {
            if (round % 64 == 0 && ticks() > end) return false;
        }
        return true;
    }
    void sleep() {
        for (;;) {
            words_.asleep.store(1, std::memory_order_relaxed);
            std::atomic_thread_fence(std::memory_order_seq_cst);
            if (arrived()) break;
            futex(FUTEX_WAIT, mine_); // the kernel looks at head again
            if (arrived()) break;
        }
        words_.asleep.store(0, std::memory_order_relaxed);
    }
    void futex(int operation, std::uint32_t value) {
        syscall(SYS_futex, &words_.head, operation, value, nullptr, nullptr, 0);
    }

    IndexRingHeader& words_;
    std::byte* slots_;
    std::uint32_t mine_ = 0, other_ = 0; // other_: the other side's index as last seen
};

} // namespace tandem::bench
