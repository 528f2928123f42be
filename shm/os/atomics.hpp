// SPDX-License-Identifier: Apache-2.0
// The operations by which rings, call queues and doorbells access memory that both sides use. These classes are templates
// over this struct, so that tests/shm/model can run the shipping code under its own scheduler and memory model: there
// Atomic<T> has the same member functions, and every access below is a step of the scheduler.
#pragma once
#include "shm/os/processor.hpp"

#include <sched.h>

namespace tandem::shm {

class BoundedSleep; // bounded_sleep.hpp

struct RealAtomics {
    /// Has load, store, exchange, fetch_add, fetch_or and compare_exchange_strong. Callers write each memory order out.
    template <class T>
    using Atomic = std::atomic<T>;

    /// A word of payloads and record headers.
    using Cell = std::uint64_t;

    static std::uint64_t load(const Cell& cell, std::memory_order order) {
        return std::atomic_ref<std::uint64_t>(const_cast<Cell&>(cell)).load(order);
    }
    static void store(Cell& cell, std::uint64_t value, std::memory_order order) {
        std::atomic_ref<std::uint64_t>(cell).store(value, order);
    }

    /// Copies word by word, by acquire loads and release stores, while the peer may be writing. Two words at a time halve the
    /// number of instructions on x86-64. Users often read a copy at once by loads of 8 or 16 bytes (vectorized loops): such a
    /// load finds its bytes in one store that is still in the store buffer.
    static void copy_atomic_from_shared(void* to, const Cell* from, std::size_t bytes) {
        auto* out = static_cast<std::byte*>(to);
        if (__builtin_constant_p(bytes) && bytes <= 64 && bytes % two_words == 0) { // without a loop
#pragma GCC unroll 4
            for (; bytes >= two_words; bytes -= two_words, out += two_words, from += 2)
                Processor::load_two_words(out, from);
            return;
        }
        for (; bytes >= two_words; bytes -= two_words, out += two_words, from += 2)
            Processor::load_two_words(out, from);
        if (bytes != 0) copy_from_shared(out, from, bytes);
    }
    static void copy_atomic_to_shared(Cell* to, const void* from, std::size_t bytes) {
        const auto* in = static_cast<const std::byte*>(from);
        if (__builtin_constant_p(bytes) && bytes <= 64 && bytes % two_words == 0) {
#pragma GCC unroll 4
            for (; bytes >= two_words; bytes -= two_words, in += two_words, to += 2)
                Processor::store_two_words(to, in);
            return;
        }
        for (; bytes >= two_words; bytes -= two_words, in += two_words, to += 2)
            Processor::store_two_words(to, in);
        if (bytes == word_bytes) { // the last word of most messages
            std::uint64_t word = 0;
            std::memcpy(&word, in, word_bytes);
            store_word(to, word);
        } else if (bytes != 0) {
            copy_to_shared(to, in, bytes);
        }
    }

    /// Requests a cell's cache line without waiting for it.
    static void prefetch(const Cell* cell) { __builtin_prefetch(cell); }

    static void fence() { std::atomic_thread_fence(std::memory_order_seq_cst); }

    /// A polling loop runs eager_rounds rounds before it pauses between rounds, and reads the clock every rounds_per_clock
    /// rounds.
    static constexpr unsigned eager_rounds = 1U << 15, rounds_per_clock = 128;
    static void pause() { Processor::pause(); }
    static void yield() { sched_yield(); }
    static std::uint64_t now() { return now_ns(); }
    static std::uint64_t ticks() { return Processor::counter(); }

    /// Bounds several sleeps of one wait.
    using BoundedSleep = shm::BoundedSleep;

    /// Sleeps while `word` holds `expected`, until it is woken or now() reaches `deadline`. May return early.
    static void futex_wait(Atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline);
    /// Wakes up to `max_sleepers` threads that sleep on `word`.
    static void futex_wake(Atomic<std::uint32_t>& word, int max_sleepers);

  private:
    static constexpr std::size_t two_words = Processor::two_words;
};

} // namespace tandem::shm
