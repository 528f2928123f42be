// SPDX-License-Identifier: Apache-2.0
// Counts durations in shared memory. Any process may read. Only one thread may write at a time: add() is not a
// read-modify-write.
#pragma once
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace tandem::shm::layout {

/// Four buckets per octave: bucket 0 counts durations below 64 ns, the last bucket all durations of 160 s or more.
struct Histogram {
    static constexpr std::size_t buckets = 128;

    static constexpr std::size_t bucket_of(std::uint64_t ns) {
        if (ns < 64) return 0;
        const auto octave = static_cast<std::size_t>(std::bit_width(ns)) - 7;
        const std::size_t bucket = 1 + 4 * octave + ((ns >> (octave + 4)) & 3U);
        return bucket < buckets ? bucket : buckets - 1;
    }
    /// Returns the shortest duration that falls into a bucket, in ns.
    static constexpr std::uint64_t lower_bound_of(std::size_t bucket) {
        return bucket == 0 ? 0 : (4 + (bucket - 1) % 4) << ((bucket - 1) / 4 + 4);
    }

    void add(std::uint64_t ns) {
        auto& count = counts[bucket_of(ns)];
        count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    }

    std::atomic<std::uint64_t> counts[buckets];
};
static_assert(sizeof(Histogram) == 1024);
static_assert(Histogram::bucket_of(64) == 1 && Histogram::lower_bound_of(1) == 64);
static_assert(Histogram::bucket_of(127) == 4 && Histogram::bucket_of(128) == 5);
static_assert(Histogram::lower_bound_of(5) == 128 && Histogram::lower_bound_of(4) == 112);

} // namespace tandem::shm::layout
