// SPDX-License-Identifier: Apache-2.0
// Which thread runs next, which store a load reads, who dies: every choice of an execution goes through here.
// A search keeps the choices of the execution as a path and changes the last one that has an alternative
// left; a random run draws them from a seed.
#pragma once
#include "tests/shm/model/checker/operation.hpp"

#include <bit>
#include <optional>
#include <random>

namespace tandem::shm::model {

using Threads = std::uint32_t; ///< a set of threads, bit i = thread i

/// Whether a thread need not run next, since all that would follow was explored before. Between the extremes
/// stands a load that was explored before a store came: it need only run to read that store or a newer one.
using Sleep = std::array<Index, max_threads>;
constexpr Index awake = 0, asleep = 0xffff;

struct Node {
    bool of_threads;
    std::uint32_t chosen, count; ///< of_threads: chosen is the thread. Else: one of 0 .. count-1
    Threads enabled = 0, todo = 0, done = 0;
    Sleep sleep{};
};

class Choices {
  public:
    /// A search over everything.
    Choices() = default;
    /// One random execution per begin().
    explicit Choices(std::uint64_t seed) : seed_(seed) {}

    bool random() const { return seed_.has_value(); }

    void begin(std::uint64_t execution) {
        at_ = 0;
        if (!random()) return;
        generator_.seed((*seed_ + execution) * 2654435761U % 2147483647U);
        patience_ = 1U << (1 + 2 * (generator_() % 3)); // keeps a thread for 2, 8 or 32 steps on average
    }

    /// The first choice of this execution that differs from the one before.
    std::size_t fresh_from() const { return path_.empty() ? 0 : path_.size() - 1; }

    /// One of `count` values. Random: `odds` to 1 for the first.
    std::uint32_t value(std::uint32_t count, unsigned odds = 1) {
        if (count == 1) return 0;
        if (random())
            return generator_() % (odds + 1) != 0 ? 0 : static_cast<std::uint32_t>(generator_() % count);
        if (at_ == path_.size()) path_.push_back({false, 0, count});
        return path_[at_++].chosen;
    }

    /// One of `can` (not empty) or `may_expire`: sleepers whose time may be up. `last` goes on if it can.
    /// None: all sleep (see Sleep), what would follow was explored before.
    std::optional<std::size_t> thread(Threads can, Threads may_expire, std::size_t last, const Sleep& sleep) {
        if (random()) return random_thread(can == 0 || generator_() % 16 == 0 ? can | may_expire : can, last);
        if (at_ == path_.size()) {
            Threads off = 0;
            for (std::size_t i = 0; i < max_threads; ++i)
                if (sleep[i] == asleep) off |= 1U << i;
            const Threads first = (can & ~off) != 0 ? can & ~off : may_expire & ~off;
            if (first == 0) return std::nullopt;
            const auto chosen = (first >> last & 1U) != 0 ? last : std::countr_zero(first);
            path_.push_back({true, static_cast<std::uint32_t>(chosen), 0, can | may_expire, 0, 0, sleep});
        }
        return path_[at_++].chosen;
    }

    std::size_t here() const { return at_; }
    Node& node(std::size_t index) { return path_[index]; }

    /// Moves on to the next unexplored path. Returns false if there is none.
    bool next() {
        for (; !path_.empty(); path_.pop_back()) {
            Node& node = path_.back();
            if (!node.of_threads) {
                if (++node.chosen < node.count) return true;
                continue;
            }
            node.done |= 1U << node.chosen;
            Threads left = node.todo & ~node.done;
            for (std::size_t i = 0; i < max_threads; ++i)
                if (node.sleep[i] == asleep) left &= ~(1U << i);
            if (left == 0) continue;
            node.chosen = static_cast<std::uint32_t>(std::countr_zero(left));
            return true;
        }
        return false;
    }

  private:
    std::size_t random_thread(Threads enabled, std::size_t last) {
        if ((enabled >> last & 1U) != 0 && generator_() % patience_ != 0) return last;
        auto skip = generator_() % static_cast<unsigned>(std::popcount(enabled));
        for (; skip != 0; --skip) enabled &= enabled - 1;
        return static_cast<std::size_t>(std::countr_zero(enabled));
    }

    std::optional<std::uint64_t> seed_;
    std::minstd_rand generator_;
    unsigned patience_ = 2;
    std::vector<Node> path_;
    std::size_t at_ = 0;
};

} // namespace tandem::shm::model
