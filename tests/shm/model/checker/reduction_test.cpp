// SPDX-License-Identifier: Apache-2.0
// The reduction checked: small random programs come to the same results with it and without it.
#include "tests/shm/fixture.hpp"
#include "tests/shm/model/checker/model.hpp"

#include <set>

namespace tandem::shm::model {
namespace {

using A = ModelAtomics;
using Word = A::Atomic<std::uint32_t>;

struct Action {
    unsigned what, word;
    Order load, store, change;
    std::uint32_t value;
};
using Program = std::vector<std::vector<Action>>;

Program make_program(std::mt19937& random, std::size_t threads, std::size_t length) {
    const auto one_of = [&](auto... orders) {
        const Order all[] = {orders...};
        return all[random() % sizeof...(orders)];
    };
    Program program(threads);
    for (auto& thread : program)
        for (std::size_t i = 0; i < length; ++i)
            thread.push_back(
                {static_cast<unsigned>(random() % 10), static_cast<unsigned>(random() % 2),
                 one_of(Order::relaxed, Order::acquire, Order::seq_cst),
                 one_of(Order::relaxed, Order::release, Order::seq_cst),
                 one_of(Order::relaxed, Order::acquire, Order::release, Order::acq_rel, Order::seq_cst),
                 static_cast<std::uint32_t>(random() % 3)});
    return program;
}

std::uint32_t perform(const Action& action, Word& word) {
    std::uint32_t expected = action.value;
    switch (action.what) {
    case 0:
    case 1:
    case 2:
        return word.load(action.load);
    case 3:
    case 4:
        word.store(action.value + 1, action.store);
        return 0;
    case 5:
        return word.fetch_add(1, action.change);
    case 6:
        return word.compare_exchange_strong(expected, 2, action.change) ? 100 : expected;
    case 7:
        A::futex_wait(word, action.value, A::now() + 1000);
        return 0;
    case 9:
        for (int i = 0; i < 2 && word.load(action.load) != action.value; ++i) A::pause();
        return word.load(action.load);
    default:
        A::futex_wake(word, 1);
        return 0;
    }
}

struct Search {
    std::set<std::vector<std::uint32_t>> all;
    Outcome outcome;
};

Search search(const Program& program, bool reduced, bool mortal) {
    Search found;
    Effort effort;
    effort.settings.reduced = reduced;
    effort.settings.lapses = 1;
    effort.executions = 400'000;
    found.outcome = explore(
        [&](Execution& execution) {
            Word x, y;
            std::vector<std::uint32_t> seen(16);
            for (std::size_t t = 0; t < program.size(); ++t)
                execution.thread(
                    "thread",
                    [&, t] {
                        for (std::size_t i = 0; i < program[t].size(); ++i)
                            seen[4 * t + i] = 1 + perform(program[t][i], program[t][i].word == 0 ? x : y);
                    },
                    0, mortal && t == 0);
            execution.run();
            seen[14] = x.load(Order::relaxed);
            seen[15] = y.load(Order::relaxed);
            found.all.insert(seen);
        },
        effort);
    return found;
}

void compare(std::size_t programs, std::size_t threads, std::size_t length, bool mortal) {
    std::mt19937 random(static_cast<unsigned>(threads * 100 + length));
    std::size_t all = 0, reduced = 0, redundant = 0;
    for (std::size_t i = 0; i < programs; ++i) {
        const auto program = make_program(random, threads, length);
        const auto with = search(program, true, mortal), without = search(program, false, mortal);
        std::string text;
        const char* names[] = {"load", "load",    "load",  "store", "store",
                               "add",  "compare", "sleep", "wake",  "poll"};
        for (const auto& thread : program) {
            for (const auto& a : thread)
                text += std::string(names[a.what]) + " " + "xy"[a.word] + " " + std::to_string(a.value) +
                        " " +
                        name_of(a.what < 3   ? a.load
                                : a.what < 5 ? a.store
                                             : a.change) +
                        "; ";
            text += "\n";
        }
        INFO(text);
        INFO("program " << i << " of " << threads << " threads of " << length);
        REQUIRE(with.outcome.failure == "");
        if (!without.outcome.complete) continue;
        REQUIRE(with.all == without.all);
        all += without.outcome.executions;
        reduced += with.outcome.executions;
        redundant += with.outcome.redundant;
    }
    INFO(threads << " threads of " << length << ": " << reduced << " executions (" << redundant
                 << " left early) instead of " << all);
    CHECK(reduced + redundant < all);
}

TEST_CASE("The reduction loses no result of two threads") { compare(test::stress(100), 2, 3, false); }
TEST_CASE("The reduction loses no result of three threads") { compare(test::stress(100), 3, 2, false); }
TEST_CASE("The reduction loses no result when a thread is killed") { compare(test::stress(100), 2, 3, true); }

} // namespace
} // namespace tandem::shm::model
