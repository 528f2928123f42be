// SPDX-License-Identifier: Apache-2.0
// The atomics policy (shm/os/atomics.hpp) of code that runs in the model.
#pragma once
#include "shm/os/clock.hpp"
#include "tests/shm/model/checker/execution.hpp"

#include <cstring>
#include <type_traits>

namespace tandem::shm::model {

struct ModelAtomics {
    template <class T>
    class Atomic {
        static_assert(sizeof(T) <= 8 && std::is_trivially_copyable_v<T>);

      public:
        Atomic(T value = T{}) : initial_(value) {}
        Atomic(const Atomic&) = delete;
        Atomic& operator=(const Atomic&) = delete;

        T load(Order order, const Site& at = Site::current()) const {
            return value_of(Execution::current().load(word(), order, at));
        }
        void store(T value, Order order, const Site& at = Site::current()) {
            Execution::current().store(word(), word_of(value), order, at);
        }
        T exchange(T value, Order order, const Site& at = Site::current()) {
            return change(order, at, [value](T) { return value; });
        }
        T fetch_add(T value, Order order, const Site& at = Site::current()) {
            return change(order, at, [value](T old) { return static_cast<T>(old + value); });
        }
        T fetch_sub(T value, Order order, const Site& at = Site::current()) {
            return change(order, at, [value](T old) { return static_cast<T>(old - value); });
        }
        T fetch_or(T value, Order order, const Site& at = Site::current()) {
            return change(order, at, [value](T old) { return static_cast<T>(old | value); });
        }
        T fetch_and(T value, Order order, const Site& at = Site::current()) {
            return change(order, at, [value](T old) { return static_cast<T>(old & value); });
        }
        bool compare_exchange_strong(T& expected, T value, Order order, Order failure,
                                     const Site& at = Site::current()) {
            std::uint64_t found = word_of(expected);
            const bool done = Execution::current().compare(word(), found, word_of(value), order, failure, at);
            expected = value_of(found);
            return done;
        }
        bool compare_exchange_strong(T& expected, T value, Order order, const Site& at = Site::current()) {
            const Order failure = order == Order::acq_rel   ? Order::acquire
                                  : order == Order::release ? Order::relaxed
                                                            : order;
            return compare_exchange_strong(expected, value, order, failure, at);
        }

      private:
        friend struct ModelAtomics;

        template <class Function>
        T change(Order order, const Site& at, Function&& function) {
            return value_of(Execution::current().change(
                word(), order, at, [&](std::uint64_t old) { return word_of(function(value_of(old))); }));
        }
        static std::uint64_t word_of(T value) {
            std::uint64_t word = 0;
            std::memcpy(&word, &value, sizeof value);
            return word;
        }
        static T value_of(std::uint64_t word) {
            T value;
            std::memcpy(&value, &word, sizeof value);
            return value;
        }

        /// The model knows only words that a thread has accessed.
        std::uint32_t word() const {
            if (word_ == no_location) word_ = Execution::current().add_word(word_of(initial_));
            return word_;
        }

        T initial_;
        mutable std::uint32_t word_ = no_location;
    };

    /// Has 8 bytes, so that offsets in bytes stay the same.
    class alignas(8) Cell {
      public:
        Cell() = default;
        Cell(const Cell&) = delete;
        Cell& operator=(const Cell&) = delete;

      private:
        friend struct ModelAtomics;
        std::uint32_t word() const {
            if (word_ == no_location) word_ = Execution::current().add_word(0);
            return word_;
        }
        mutable std::uint32_t word_ = no_location;
    };

    static std::uint64_t load(const Cell& cell, Order order, const Site& at = Site::current()) {
        return Execution::current().load(cell.word(), order, at);
    }
    static void store(Cell& cell, std::uint64_t value, Order order, const Site& at = Site::current()) {
        Execution::current().store(cell.word(), value, order, at);
    }

    static void copy_atomic_from_shared(void* to, const Cell* from, std::size_t bytes,
                                        const Site& at = Site::current()) {
        out(to, from, bytes, [&](const Cell& cell) { return load(cell, Order::acquire, at); });
    }
    static void copy_atomic_to_shared(Cell* to, const void* from, std::size_t bytes,
                                      const Site& at = Site::current()) {
        in(to, from, bytes, [&](Cell& cell, std::uint64_t value) { store(cell, value, Order::release, at); });
    }
    static void copy_plain_from_shared(void* to, const Cell* from, std::size_t bytes,
                                       const Site& at = Site::current()) {
        out(to, from, bytes, [&](const Cell& cell) { return Execution::current().take(cell.word(), at); });
    }
    static void copy_plain_to_shared(Cell* to, const void* from, std::size_t bytes,
                                     const Site& at = Site::current()) {
        in(to, from, bytes,
           [&](Cell& cell, std::uint64_t value) { Execution::current().put(cell.word(), value, at); });
    }

    static void prefetch(const Cell*) {}

    /// For scenarios: see Execution::settle().
    static void settle(const Cell* cells, std::size_t bytes, const Site& at = Site::current()) {
        for (std::size_t i = 0; i < (bytes + 7) / 8; ++i) Execution::current().settle(cells[i].word(), at);
    }

    static void fence(const Site& at = Site::current()) { Execution::current().fence(at); }
    /// Few, because each is a step, and always with a pause, because without it a round that finds no news
    /// would be repeated for ever.
    static constexpr unsigned eager_rounds = 0, rounds_per_clock = 2;
    static void pause(const Site& at = Site::current()) { Execution::current().pause(at); }
    static void yield(const Site& at = Site::current()) { Execution::current().pause(at); }
    static std::uint64_t now() { return Execution::current().now(); }
    /// Stands still: only how long an owner polls the next time depends on it.
    static std::uint64_t ticks() { return 0; }

    /// A bound of longest_wait does not come, so that a wake-up which is lost is a failure.
    class BoundedSleep {
      public:
        explicit BoundedSleep(std::chrono::nanoseconds bound)
            : deadline_(bound >= longest_wait ? Execution::never : now() + bounded_ns(bound)) {}
        bool sleep_while(Atomic<std::uint32_t>& word, std::uint32_t expected,
                         const Site& at = Site::current()) {
            if (now() >= deadline_) return false;
            futex_wait(word, expected, deadline_, at);
            return true;
        }

      private:
        std::uint64_t deadline_;
    };

    static void futex_wait(Atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline,
                           const Site& at = Site::current()) {
        Execution::current().sleep(word.word(), expected, deadline, at);
    }
    static void futex_wake(Atomic<std::uint32_t>& word, int sleepers, const Site& at = Site::current()) {
        Execution::current().wake(word.word(), sleepers, at);
    }

  private:
    template <class Read>
    static void out(void* to, const Cell* from, std::size_t bytes, Read&& read) {
        auto* next = static_cast<std::byte*>(to);
        for (; bytes != 0; ++from) {
            const std::uint64_t word = read(*from);
            const std::size_t part = std::min<std::size_t>(bytes, sizeof word);
            std::memcpy(next, &word, part);
            next += part;
            bytes -= part;
        }
    }
    template <class Write>
    static void in(Cell* to, const void* from, std::size_t bytes, Write&& write) {
        const auto* next = static_cast<const std::byte*>(from);
        for (; bytes != 0; ++to) {
            const std::size_t part = std::min<std::size_t>(bytes, sizeof(std::uint64_t));
            std::uint64_t word = 0;
            std::memcpy(&word, next, part);
            write(*to, word);
            next += part;
            bytes -= part;
        }
    }
};

} // namespace tandem::shm::model
