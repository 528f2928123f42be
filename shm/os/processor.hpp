// SPDX-License-Identifier: Apache-2.0
// What differs between processors. All other code of Tandem except crash reports and the benchmarks is portable C++. A form
// for one processor has the effects of the portable form under the C++ memory model.
#pragma once
#include "shm/os/clock.hpp"
#include "shm/os/shared_copy.hpp"

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

namespace tandem::shm {

struct PortableProcessor {
    /// Tells the processor that this thread is polling.
    static void pause() {}

    /// Returns a counter that is cheap to read. It may go backwards when a thread migrates to another core.
    static std::uint64_t counter() { return now_ns(); }
    /// Returns the lowest frequency that the counter may have, in Hz.
    static std::uint64_t min_counter_hz() { return 1'000'000'000; }

    static constexpr std::size_t two_words = 2 * word_bytes;
    /// Copies two words out of shared memory, each by an acquire load. `shared` is 8-aligned.
    static void load_two_words(void* to, const void* shared) { copy_from_shared(to, shared, two_words); }
    /// Copies two words into shared memory, each by a release store. `shared` is 8-aligned.
    static void store_two_words(void* shared, const void* from) { copy_to_shared(shared, from, two_words); }
};

#if defined(__x86_64__)

/// x86-64 keeps the order of loads and of stores of any size, and tears no aligned word.
struct Processor : PortableProcessor {
    static void pause() { _mm_pause(); }

    /// Returns the time-stamp counter.
    static std::uint64_t counter() { return __builtin_ia32_rdtsc(); }
    static constexpr std::uint64_t min_counter_hz() { return 1'000'000'000; }

#ifndef __SANITIZE_THREAD__ // the thread sanitizer knows the order only of atomic words
    static void load_two_words(void* to, const void* shared) {
        const __m128i pair = _mm_loadu_si128(static_cast<const __m128i*>(shared));
        std::atomic_signal_fence(std::memory_order_acquire);
        _mm_storeu_si128(static_cast<__m128i*>(to), pair);
    }
    static void store_two_words(void* shared, const void* from) {
        const __m128i pair = _mm_loadu_si128(static_cast<const __m128i*>(from));
        std::atomic_signal_fence(std::memory_order_release);
        _mm_storeu_si128(static_cast<__m128i*>(shared), pair);
    }
#endif
};

#elif defined(__aarch64__)

struct Processor : PortableProcessor {
    static void pause() { asm volatile("isb" ::: "memory"); } // most cores ignore `yield`

    /// Returns the generic timer, whose ticks take 1 to 53 ns.
    static std::uint64_t counter() {
        std::uint64_t ticks = 0;
        asm volatile("mrs %0, cntvct_el0" : "=r"(ticks));
        return ticks;
    }
    static std::uint64_t min_counter_hz() {
        std::uint64_t hz = 0;
        asm("mrs %0, cntfrq_el0" : "=r"(hz));
        return hz;
    }
};

#else

using Processor = PortableProcessor;

#endif

/// Returns a number of ticks that take at most `ns` nanoseconds, up to 1 s.
template <class P = Processor>
constexpr std::uint64_t ticks_within(std::uint64_t ns) {
    return ns * P::min_counter_hz() / 1'000'000'000;
}

} // namespace tandem::shm
