// SPDX-License-Identifier: Apache-2.0
// The checker checked: sleeping and waking, spinning, deadlines, death.
#include "tests/shm/model/checker/model.hpp"

#include <catch2/catch.hpp>
#include <set>

namespace tandem::shm::model {
namespace {

using A = ModelAtomics;
using Word = A::Atomic<std::uint32_t>;

using enum Order;
constexpr std::uint64_t never = ~std::uint64_t{0};

/// The protocol of shm/os/futex.hpp.
Outcome sleeper_and_waker(Order announce, Order look, bool wakes, std::optional<std::uint64_t> seed = {}) {
    Effort effort;
    effort.seed = seed;
    if (seed) effort.executions = 2000;
    return explore(
        [&](Execution& execution) {
            Word data, sleeps;
            execution.thread("sleeper", [&] {
                while (data.load(look) == 0) {
                    sleeps.store(1, announce);
                    if (data.load(look) != 0) break;
                    A::futex_wait(sleeps, 1, never);
                }
            });
            execution.thread("waker", [&] {
                data.store(1, announce);
                if (sleeps.load(look) == 0 || sleeps.exchange(0, announce) == 0) return;
                if (wakes) A::futex_wake(sleeps, 1);
            });
            execution.run();
        },
        effort);
}

TEST_CASE("A wake-up is never lost with seq_cst, but is lost with a weaker order or without the wake") {
    CHECK(sleeper_and_waker(seq_cst, seq_cst, true).passed());
    CHECK_THAT(sleeper_and_waker(release, acquire, true).failure, Catch::Contains("nobody is left to wake"));
    CHECK_THAT(sleeper_and_waker(seq_cst, seq_cst, false).failure, Catch::Contains("nobody is left to wake"));
}

TEST_CASE("Random executions find a lost wake-up and repeat it from their seed") {
    const auto first = sleeper_and_waker(release, acquire, true, 1);
    CHECK_THAT(first.failure, Catch::Contains("nobody is left to wake"));
    CHECK(sleeper_and_waker(release, acquire, true, 1).failure == first.failure);
    CHECK(sleeper_and_waker(seq_cst, seq_cst, true, 1).passed());
}

TEST_CASE("A claim about the end is checked") {
    const auto all = explore(
        [&](Execution& execution) {
            Word word;
            execution.thread("writer", [&] { word.store(1, relaxed); });
            execution.run();
            execution.require(word.load(relaxed) == 2, "the word is two");
        },
        {});
    CHECK_THAT(all.failure, Catch::Contains("the word is two"));
}

TEST_CASE("A sleeper with a deadline wakes up") {
    const auto all = explore(
        [](Execution& execution) {
            Word word;
            std::uint64_t end = 0;
            execution.thread("sleeper", [&] {
                const auto deadline = A::now() + 1000;
                A::futex_wait(word, 0, deadline);
                end = A::now() - deadline;
            });
            execution.run();
            execution.require(end < 1000, "it slept to the deadline");
        },
        {});
    CHECK(all.passed());
}

TEST_CASE("A spinning thread sees either its condition or its deadline") {
    for (const bool comes : {true, false}) {
        std::set<bool> seen;
        const auto all = explore(
            [&](Execution& execution) {
                Word word;
                bool found = false;
                execution.thread("spinner", [&] {
                    const auto deadline = A::now() + 1000;
                    while (!(found = word.load(acquire) == 1) && A::now() < deadline) A::pause();
                });
                if (comes) execution.thread("writer", [&] { word.store(1, release); });
                execution.run();
                seen.insert(found);
            },
            {});
        CHECK(all.passed());
        CHECK(seen == std::set<bool>{comes});
    }
}

TEST_CASE("A thread is killed before each of its stores, and its earlier stores are visible") {
    std::set<std::pair<std::uint32_t, bool>> found;
    const auto all = explore(
        [&](Execution& execution) {
            Word word;
            execution.thread(
                "mortal", [&] { word.store(1, relaxed), word.store(2, relaxed); }, 0, true);
            execution.thread("watcher", [&] {
                const bool lives = execution.lives(1);
                found.insert({word.load(relaxed), lives});
            });
            execution.run();
        },
        {});
    CHECK(all.passed());
    CHECK(found ==
          std::set<std::pair<std::uint32_t, bool>>{{0, true}, {1, true}, {2, true}, {0, false}, {1, false}});
}

TEST_CASE("Threads of one process die together") {
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    const auto all = explore(
        [&](Execution& execution) {
            Word x, y;
            execution.thread(
                "one", [&] { x.store(1, relaxed); }, 1, true);
            execution.thread(
                "other", [&] { y.store(1, relaxed); }, 1);
            execution.run();
            found.insert({x.load(relaxed), y.load(relaxed)});
        },
        {});
    CHECK(all.passed());
    CHECK(found == std::set<std::pair<std::uint32_t, std::uint32_t>>{{0, 0}, {0, 1}, {1, 1}});
}

} // namespace
} // namespace tandem::shm::model
