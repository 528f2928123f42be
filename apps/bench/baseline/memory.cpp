// SPDX-License-Identifier: Apache-2.0
// What one core does with memory alone: copy, fill, sum.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/measurements.hpp"

#include <cstring>

namespace tandem::bench {

namespace {

/// Windows of repeated work on the case's bytes, as GB/s.
template <class Work>
void repeat(Session& session, Work&& work) {
    const auto bytes = static_cast<double>(session.bytes());
    const std::uint64_t window = to_ticks(session.limits().window_seconds * 1e9 / 3);
    for (int i = -1; i < session.limits().windows; ++i) {
        const std::uint64_t begin = ticks();
        std::uint64_t now = begin, rounds = 0;
        for (; now - begin < window; now = ticks()) work(++rounds);
        if (i >= 0) session.result(static_cast<double>(rounds) * bytes / to_ns(now - begin));
    }
}

void copy(Session& session) {
    std::byte* from = session.memory().data();
    std::byte* to = from + session.memory().size() / 2;
    fill(from, session.bytes(), 1);
    repeat(session, [&](std::uint64_t) {
        std::memcpy(to, from, session.bytes());
        asm volatile("" ::: "memory"); // or all copies but the last might go
    });
    sequence_of(to, session.bytes());
}

void fill_only(Session& session) {
    repeat(session, [&](std::uint64_t round) { fill(session.memory().data(), session.bytes(), round); });
}

void sum_only(Session& session) {
    fill(session.memory().data(), session.bytes(), 1);
    repeat(session, [&](std::uint64_t) {
        asm volatile("" ::: "memory");
        sequence_of(session.memory().data(), session.bytes());
    });
}

} // namespace

void add_floor_memory_cases(Registry& registry) {
    for (std::size_t bytes : {std::size_t{1} << 20U, std::size_t{6} << 20U}) {
        Case one;
        one.group = Group::floor;
        one.bytes = bytes;
        one.what = "stream";
        one.wake = Wake::none;
        one.placement = Placement::alone;
        one.unit = Unit::gigabytes;
        one.who = "memcpy";
        one.run = copy;
        registry.cases.push_back(one);
        one.who = "fill";
        one.run = fill_only;
        registry.cases.push_back(one);
        one.who = "sum";
        one.run = sum_only;
        registry.cases.push_back(one);
    }
}

} // namespace tandem::bench
