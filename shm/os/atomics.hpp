// SPDX-License-Identifier: Apache-2.0
// How the ring and the call queue touch memory that both sides use. They are templates over this struct, so
// that the code that ships is the code that tests/shm/model runs under a scheduler and a memory model of its
// own: there Atomic<T> has the same member functions, and every access below is a step of the scheduler.
#pragma once
#include "shm/os/clock.hpp"
#include "shm/os/shared_copy.hpp"

#include <immintrin.h>
#include <sched.h>

namespace tandem::shm {

class BoundedSleep; // futex.hpp

struct RealAtomics {
    /// load, store, exchange, fetch_add, fetch_or, compare_exchange_strong, each with its order written out.
    template <class T>
    using Atomic = std::atomic<T>;

    /// A word of record memory: payload and record headers.
    using Cell = std::uint64_t;

    static std::uint64_t load(const Cell& cell, std::memory_order order) {
        return std::atomic_ref<std::uint64_t>(const_cast<Cell&>(cell)).load(order);
    }
    static void store(Cell& cell, std::uint64_t value, std::memory_order order) {
        std::atomic_ref<std::uint64_t>(cell).store(value, order);
    }

    /// Word-wise copies that may overlap with the other side's writing: acquire loads, release stores.
    static void copy_out(void* to, const Cell* from, std::size_t bytes) { copy_pairs(to, from, bytes); }
    static void copy_in(Cell* to, const void* from, std::size_t bytes) { copy_to_shared(to, from, bytes); }

    /// Plain copies of memory that, by protocol, is this side's alone at the moment. Short ones go by words
    /// of 8: memcpy would load 32 bytes at once from what the user has just stored in smaller pieces, which
    /// waits until those stores have left the store buffer (measured: 100 ns of a 150 ns way).
    static void take_out(void* to, const Cell* from, std::size_t bytes) {
        if (bytes <= by_words) return copy_pairs(to, from, bytes);
        std::memcpy(to, from, bytes);
    }
    static void put_in(Cell* to, const void* from, std::size_t bytes) {
        if (bytes <= by_words) return copy_to_shared(to, from, bytes);
        std::memcpy(to, from, bytes);
    }
    static constexpr std::size_t by_words = 256;

    /// Out of shared memory two words at a time: the user may look at the copy at once by loads of 8 or of 16
    /// bytes (sums that the compiler has vectorized), and both are served from such stores. x86-64 keeps the
    /// order of loads whatever their size; the thread sanitizer only knows that of atomic words.
    static void copy_pairs(void* to, const Cell* from, std::size_t bytes) {
        auto* out = static_cast<std::byte*>(to);
#ifndef __SANITIZE_THREAD__
        for (; bytes >= sizeof(__m128i); bytes -= sizeof(__m128i), out += sizeof(__m128i), from += 2) {
            const __m128i pair = _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
            std::atomic_signal_fence(std::memory_order_acquire);
            _mm_storeu_si128(reinterpret_cast<__m128i*>(out), pair);
        }
#endif
        copy_from_shared(out, from, bytes);
    }

    /// Asks for a cell's cache line without waiting for it.
    static void prefetch(const Cell* cell) { _mm_prefetch(cell, _MM_HINT_T0); }

    static void fence() { std::atomic_thread_fence(std::memory_order_seq_cst); }
    /// How a loop polls: so many rounds without a pause between them, and from one look at the clock to the
    /// next.
    static constexpr unsigned eager_rounds = 1U << 15, rounds_per_clock = 128;
    static void pause() { _mm_pause(); }
    static void yield() { sched_yield(); }
    static std::uint64_t now() { return now_ns(); }

    /// Several sleeps of one wait.
    using BoundedSleep = shm::BoundedSleep;

    /// Sleeps while `word` holds `expected`, until woken or now() reaches `deadline`; may return early.
    static void futex_wait(Atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline);
    static void futex_wake(Atomic<std::uint32_t>& word, int sleepers);
};

} // namespace tandem::shm
