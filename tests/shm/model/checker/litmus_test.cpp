// SPDX-License-Identifier: Apache-2.0
// Tests the checker with programs of two to four threads whose possible outcomes the C++ memory model
// defines.
#include "tests/shm/model/checker/model.hpp"

#include <catch2/catch.hpp>
#include <set>

namespace tandem::shm::model {
namespace {

using A = ModelAtomics;
using Word = A::Atomic<std::uint32_t>;
using Results = std::set<std::vector<std::uint32_t>>;

using enum Order;

/// The words and the registers of a litmus test.
struct Litmus {
    Word x, y, z;
    std::vector<std::uint32_t> r;
};
using Part = std::function<void(Litmus&)>;

/// All values that the registers can hold at the end.
Results results(std::size_t registers, const std::vector<Part>& parts, Outcome* outcome = nullptr) {
    Results found;
    const auto all = explore(
        [&](Execution& execution) {
            Litmus litmus;
            litmus.r.resize(registers);
            for (std::size_t i = 0; i < parts.size(); ++i)
                execution.thread("thread " + std::to_string(i), [&, i] { parts[i](litmus); });
            execution.run();
            found.insert(litmus.r);
        },
        {});
    CHECK(all.passed());
    CHECK(all.complete);
    if (outcome != nullptr) *outcome = all;
    return found;
}

Results message_passing(Order store, Order load) {
    return results(2, {[=](Litmus& l) {
                           l.x.store(1, relaxed);
                           l.y.store(1, store);
                       },
                       [=](Litmus& l) {
                           l.r[0] = l.y.load(load);
                           l.r[1] = l.x.load(relaxed);
                       }});
}

TEST_CASE("Message passing needs a release and an acquire") {
    CHECK(message_passing(relaxed, acquire).count({1, 0}) == 1);
    CHECK(message_passing(release, relaxed).count({1, 0}) == 1);
    CHECK(message_passing(release, acquire) == Results{{0, 0}, {0, 1}, {1, 1}});
    CHECK(message_passing(seq_cst, seq_cst) == Results{{0, 0}, {0, 1}, {1, 1}});
}

Results store_buffering(Order store, Order load, bool fence) {
    return results(2, {[=](Litmus& l) {
                           l.x.store(1, store);
                           if (fence) A::fence();
                           l.r[0] = l.y.load(load);
                       },
                       [=](Litmus& l) {
                           l.y.store(1, store);
                           if (fence) A::fence();
                           l.r[1] = l.x.load(load);
                       }});
}

TEST_CASE("Only sequential consistency or fences forbid store buffering") {
    CHECK(store_buffering(release, acquire, false).count({0, 0}) == 1);
    CHECK(store_buffering(seq_cst, acquire, false).count({0, 0}) == 1);
    CHECK(store_buffering(release, seq_cst, false).count({0, 0}) == 1);
    CHECK(store_buffering(seq_cst, seq_cst, false) == Results{{0, 1}, {1, 0}, {1, 1}});
    CHECK(store_buffering(relaxed, relaxed, true) == Results{{0, 1}, {1, 0}, {1, 1}});
}

TEST_CASE("A fence on one side and seq_cst accesses on the other forbid store buffering") {
    const auto found = results(2, {[](Litmus& l) {
                                       l.x.store(1, relaxed);
                                       A::fence();
                                       l.r[0] = l.y.load(relaxed);
                                   },
                                   [](Litmus& l) {
                                       l.y.store(1, seq_cst);
                                       l.r[1] = l.x.load(seq_cst);
                                   }});
    CHECK(found == Results{{0, 1}, {1, 0}, {1, 1}});
}

TEST_CASE("Two loads of one word never see its values in reverse order") {
    const auto found = results(2, {[](Litmus& l) {
                                       l.x.store(1, relaxed);
                                       l.x.store(2, relaxed);
                                   },
                                   [](Litmus& l) {
                                       l.r[0] = l.x.load(relaxed);
                                       l.r[1] = l.x.load(relaxed);
                                   }});
    CHECK(found == Results{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}});
}

Results independent_writes(Order load, bool fence) {
    const auto reader = [=](Word Litmus::*first, Word Litmus::*second, std::size_t r) {
        return [=](Litmus& l) {
            l.r[r] = (l.*first).load(load);
            if (fence) A::fence();
            l.r[r + 1] = (l.*second).load(load);
        };
    };
    return results(4, {[=](Litmus& l) { l.x.store(1, load == seq_cst ? seq_cst : release); },
                       [=](Litmus& l) { l.y.store(1, load == seq_cst ? seq_cst : release); },
                       reader(&Litmus::x, &Litmus::y, 0), reader(&Litmus::y, &Litmus::x, 2)});
}

TEST_CASE("Two readers agree on the order of independent writes only under sequential consistency") {
    CHECK(independent_writes(acquire, false).count({1, 0, 1, 0}) == 1);
    CHECK(independent_writes(seq_cst, false).count({1, 0, 1, 0}) == 0);
    CHECK(independent_writes(seq_cst, false).size() == 15);
    CHECK(independent_writes(relaxed, true).count({1, 0, 1, 0}) == 0);
    CHECK(independent_writes(relaxed, true).size() == 15);
}

TEST_CASE("A read-modify-write continues a release sequence and a plain store does not") {
    const auto with = [](bool exchange) {
        return results(3, {[](Litmus& l) {
                               l.x.store(1, relaxed);
                               l.y.store(1, release);
                           },
                           [=](Litmus& l) {
                               if (exchange)
                                   l.r[2] = l.y.fetch_add(1, relaxed);
                               else if ((l.r[2] = l.y.load(relaxed)) == 1)
                                   l.y.store(2, relaxed);
                           },
                           [](Litmus& l) {
                               l.r[0] = l.y.load(acquire);
                               l.r[1] = l.x.load(relaxed);
                           }});
    };
    CHECK(with(true).count({2, 1, 1}) == 1);
    CHECK(with(true).count({2, 0, 1}) == 0);
    CHECK(with(false).count({2, 0, 1}) == 1);
}

TEST_CASE("A release passes on what an acquire has seen") {
    const auto found = results(2, {[](Litmus& l) { l.x.store(1, release); },
                                   [](Litmus& l) {
                                       if (l.x.load(acquire) == 1) l.y.store(1, release);
                                   },
                                   [](Litmus& l) {
                                       l.r[0] = l.y.load(acquire);
                                       l.r[1] = l.x.load(relaxed);
                                   }});
    CHECK(found == Results{{0, 0}, {0, 1}, {1, 1}});
}

TEST_CASE("Of two compare-exchanges from one value exactly one succeeds") {
    const auto taker = [](std::size_t r) {
        return [r](Litmus& l) {
            std::uint32_t expected = 0;
            l.r[r] =
                l.x.compare_exchange_strong(expected, static_cast<std::uint32_t>(r + 1), acq_rel, acquire)
                    ? 1
                    : 0;
        };
    };
    CHECK(results(2, {taker(0), taker(1)}) == Results{{0, 1}, {1, 0}});
}

TEST_CASE("Increments are never lost") {
    const auto add = [](Litmus& l) {
        l.x.fetch_add(1, relaxed);
        l.x.fetch_add(1, relaxed);
    };
    Results found;
    const auto all = explore(
        [&](Execution& execution) {
            Litmus litmus;
            for (int i = 0; i < 3; ++i) execution.thread("adder", [&] { add(litmus); });
            execution.run();
            execution.require(litmus.x.load(relaxed) == 6, "all additions are in the sum");
        },
        {});
    CHECK(all.passed());
    CHECK(all.complete);
    CHECK(all.executions == 90); // orders of six steps of three threads: 6! / 2!^3
    CHECK(all.redundant == 0);
}

TEST_CASE("Loads and steps on different words add no executions") {
    Outcome outcome;
    results(2,
            {[](Litmus& l) { l.x.store(1, relaxed), l.x.store(2, relaxed), l.x.store(3, relaxed); },
             [](Litmus& l) { l.y.store(1, relaxed), l.y.store(2, relaxed), l.y.store(3, relaxed); },
             [](Litmus& l) { l.r[0] = l.z.load(acquire), l.r[1] = l.z.load(acquire); }},
            &outcome);
    CHECK(outcome.executions == 1);
}

Outcome plain_hand_over(Order order) {
    return explore(
        [&](Execution& execution) {
            A::Cell cell;
            Word flag;
            std::uint64_t seen = 0;
            execution.thread("writer", [&] {
                const std::uint64_t value = 7;
                A::copy_plain_to_shared(&cell, &value, sizeof value);
                flag.store(1, order);
            });
            execution.thread("reader", [&] {
                if (flag.load(acquire) != 1) return;
                A::copy_plain_from_shared(&seen, &cell, sizeof seen);
                execution.require(seen == 7, "what was handed over is whole");
            });
            execution.run();
        },
        {});
}

TEST_CASE("A data race on plain memory is found") {
    CHECK(plain_hand_over(release).passed());
    CHECK_THAT(plain_hand_over(relaxed).failure, Catch::Contains("data race"));
}

} // namespace
} // namespace tandem::shm::model
