// SPDX-License-Identifier: Apache-2.0
// The atomics of shm/os/atomics.hpp, with a point after every store: a process can be told to die, by a SIGKILL
// to itself, at the k-th point that it passes. The name of a point is the source line of the store. The
// memory is laid out like that of RealAtomics, so one side may be this and the other what ships.
#pragma once
#include "shared.hpp"
#include "shm/os/bounded_sleep.hpp"
#include "shm/segment/layout.hpp"

#include <csignal>
#include <cstdio>
#include <source_location>
#include <unistd.h>

namespace tandem::shm::test {

/// Where the process that is to die has got to; in memory that outlives it.
struct Points {
    unsigned countdown = 0; ///< 0: does not die
    char name[160] = {};    ///< of the point at which it died

    /// Points of this process from now on.
    static inline Points* mine = nullptr;

    static void pass(const std::source_location& at) {
        if (mine == nullptr || mine->countdown == 0 || --mine->countdown != 0) return;
        const std::string file = at.file_name();
        std::snprintf(mine->name, sizeof mine->name, "%s:%u", file.substr(file.rfind('/') + 1).c_str(),
                      at.line());
        kill(getpid(), SIGKILL);
    }
};

struct CrashPointAtomics : RealAtomics {
    using Order = std::memory_order;
    using Where = std::source_location;

    template <class T>
    class Atomic {
      public:
        Atomic() = default;
        Atomic(T value) : value_(value) {}
        T load(Order order) const { return value_.load(order); }
        void store(T value, Order order, Where at = Where::current()) {
            value_.store(value, order);
            Points::pass(at);
        }
        T exchange(T value, Order order, Where at = Where::current()) {
            return passed(value_.exchange(value, order), at);
        }
        T fetch_add(T value, Order order, Where at = Where::current()) {
            return passed(value_.fetch_add(value, order), at);
        }
        T fetch_sub(T value, Order order, Where at = Where::current()) {
            return passed(value_.fetch_sub(value, order), at);
        }
        T fetch_or(T value, Order order, Where at = Where::current()) {
            return passed(value_.fetch_or(value, order), at);
        }
        bool compare_exchange_strong(T& expected, T value, Order order, Where at = Where::current()) {
            return passed(value_.compare_exchange_strong(expected, value, order), at);
        }
        bool compare_exchange_strong(T& expected, T value, Order success, Order failure,
                                     Where at = Where::current()) {
            return passed(value_.compare_exchange_strong(expected, value, success, failure), at);
        }
        std::atomic<T>& real() { return value_; }

      private:
        template <class R>
        static R passed(R result, const Where& at) {
            Points::pass(at);
            return result;
        }
        std::atomic<T> value_{};
    };

    static void store(Cell& cell, std::uint64_t value, Order order, Where at = Where::current()) {
        RealAtomics::store(cell, value, order);
        Points::pass(at);
    }
    static void copy_atomic_to_shared(Cell* to, const void* from, std::size_t bytes,
                                      Where at = Where::current()) {
        const auto* words = static_cast<const std::byte*>(from);
        for (std::size_t done = 0; done < bytes; done += word_bytes) {
            copy_to_shared(to + done / word_bytes, words + done, std::min(word_bytes, bytes - done));
            Points::pass(at);
        }
    }
    static void futex_wait(Atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline) {
        RealAtomics::futex_wait(word.real(), expected, deadline);
    }
    static void futex_wake(Atomic<std::uint32_t>& word, int sleepers, Where at = Where::current()) {
        RealAtomics::futex_wake(word.real(), sleepers);
        Points::pass(at);
    }
};

static_assert(sizeof(layout::BasicRingHeader<CrashPointAtomics>) == sizeof(layout::RingHeader));
static_assert(sizeof(layout::BasicChunkWords<CrashPointAtomics>) == sizeof(layout::ChunkWords));
static_assert(sizeof(layout::BasicCallQueueHeader<CrashPointAtomics>) == sizeof(layout::CallQueueHeader));
static_assert(sizeof(layout::BasicCallSlot<CrashPointAtomics>) == sizeof(layout::CallSlot));

} // namespace tandem::shm::test
