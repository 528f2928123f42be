// SPDX-License-Identifier: Apache-2.0
// A hostile peer made of the fuzzer's input: it rewrites words of the shared memory between the operations of
// the victim and, through the atomics of this header, before any of the victim's looks at shared words. All
// in one thread, so every finding can be repeated.
#pragma once
#include "shm/os/bounded_sleep.hpp"
#include "shm/ring/ring_view.hpp"
#include "shm/segment/layout.hpp"

#include <span>

namespace tandem::shm::fuzz {

/// The fuzzer's bytes, taken one after another; zeros when they are used up.
class Input {
  public:
    Input(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
    bool used_up() const { return at_ == end_; }
    std::uint8_t byte() { return at_ == end_ ? std::uint8_t{0} : *at_++; }
    std::uint64_t number(int bytes) {
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) value = value << 8U | byte();
        return value;
    }

  private:
    const std::uint8_t *at_, *end_;
};

class Mutator {
  public:
    /// From now on it writes to this memory; at `records` the records or slots begin.
    static void unleash(Input& input, std::span<std::byte> target, std::size_t records = 0) {
        input_ = &input, target_ = target, records_ = records;
    }
    static void restrain() { input_ = nullptr; }

    /// Called before the victim reads shared memory; changes it about every eighth time.
    static void look() {
        if (input_ != nullptr && !input_->used_up() && input_->byte() < 32) rewrite();
    }

    static void rewrite() {
        Input& input = *input_;
        const std::size_t words = target_.size() / word_bytes;
        std::size_t at = input.number(2);
        // Mostly changes the words that matter: the first words of the lines of headers, records and slots.
        const std::size_t line = at / 4 % 12, in_line = at / 64 % 4 == 0 ? at / 256 % 8 : at / 128 % 2;
        const std::size_t where = at % 4;
        if (where == 0) at = 8 * line + in_line;
        if (where == 1 || where == 2) at = records_ / word_bytes + 8 * (line % 8) + in_line;
        auto& word = *reinterpret_cast<std::uint64_t*>(target_.data() + at % words * word_bytes);
        std::atomic_ref<std::uint64_t> shared(word);
        shared.store(value_like(shared.load(std::memory_order_relaxed)), std::memory_order_relaxed);
    }

  private:
    /// Plausible words find more errors than words that are refused at once.
    static std::uint64_t value_like(std::uint64_t old) {
        Input& input = *input_;
        const std::uint8_t how = input.byte();
        switch (how % 8) {
        case 0:
            return input.number(8);
        case 1:
            return input.byte();
        case 2:
            return old + 64 * (how / 8U);
        case 3:
            return old - 64 * (how / 8U);
        case 4:
            return old ^ std::uint64_t{1} << (how / 8U + 32U * (input.byte() & 1U));
        case 5:
            return (old & ~std::uint64_t{0x3fffffff}) | input.number(2) % 1024;
        case 6:
            return CommitWord::pack(static_cast<layout::RecordKind>(how / 8U & 3U), input.byte(),
                                    how / 32U + 1U);
        default:
            return 0;
        }
    }

    static inline Input* input_ = nullptr;
    static inline std::span<std::byte> target_;
    static inline std::size_t records_ = 0;
};

struct MutatedAtomics : RealAtomics {
    using Order = std::memory_order;

    template <class T>
    class Atomic {
      public:
        Atomic() = default;
        Atomic(T value) : value_(value) {}
        T load(Order order) const { return Mutator::look(), value_.load(order); }
        void store(T value, Order order) { value_.store(value, order); }
        T exchange(T value, Order order) { return Mutator::look(), value_.exchange(value, order); }
        T fetch_add(T value, Order order) { return value_.fetch_add(value, order); }
        T fetch_sub(T value, Order order) { return value_.fetch_sub(value, order); }
        T fetch_or(T value, Order order) { return value_.fetch_or(value, order); }
        template <class... Orders>
        bool compare_exchange_strong(T& expected, T value, Orders... orders) {
            return Mutator::look(), value_.compare_exchange_strong(expected, value, orders...);
        }
        std::atomic<T>& real() { return value_; }

      private:
        std::atomic<T> value_{};
    };

    static std::uint64_t load(const Cell& cell, Order order) {
        return Mutator::look(), RealAtomics::load(cell, order);
    }
    static void copy_atomic_from_shared(void* to, const Cell* from, std::size_t bytes) {
        auto* out = static_cast<std::byte*>(to);
        for (std::size_t done = 0; done < bytes; done += word_bytes) {
            Mutator::look();
            copy_from_shared(out + done, from + done / word_bytes, std::min(word_bytes, bytes - done));
        }
    }
    static void futex_wait(Atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline) {
        RealAtomics::futex_wait(word.real(), expected, deadline);
    }
    static void futex_wake(Atomic<std::uint32_t>& word, int sleepers) {
        RealAtomics::futex_wake(word.real(), sleepers);
    }
};

} // namespace tandem::shm::fuzz
