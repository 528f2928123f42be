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
    const std::uint64_t window = to_ticks(session.budget().window_seconds * 1e9 / 3);
    for (int i = -1; i < session.budget().windows; ++i) {
        const std::uint64_t begin = ticks();
        std::uint64_t now = begin, rounds = 0;
        for (; now - begin < window; now = ticks()) work(++rounds);
        if (i >= 0) session.add_result(static_cast<double>(rounds) * bytes / to_ns(now - begin));
    }
}

void copy(Session& session) {
    std::byte* from = session.memory().data();
    std::byte* to = from + session.memory().size() / 2;
    fill_message(from, session.bytes(), 1);
    repeat(session, [&](std::uint64_t) {
        std::memcpy(to, from, session.bytes());
        asm volatile("" ::: "memory"); // or all copies but the last might go
    });
    checked_sequence(to, session.bytes());
}

void fill_only(Session& session) {
    repeat(session,
           [&](std::uint64_t round) { fill_message(session.memory().data(), session.bytes(), round); });
}

void sum_only(Session& session) {
    fill_message(session.memory().data(), session.bytes(), 1);
    repeat(session, [&](std::uint64_t) {
        asm volatile("" ::: "memory");
        checked_sequence(session.memory().data(), session.bytes());
    });
}

} // namespace

void add_memory_cases(Registry& registry) {
    for (std::size_t bytes : {std::size_t{1} << 20U, std::size_t{6} << 20U}) {
        Case entry;
        entry.group = Group::baseline;
        entry.bytes = bytes;
        entry.operation = "stream";
        entry.wake = Wake::none;
        entry.placement = Placement::alone;
        entry.unit = Unit::gigabytes;
        entry.subject = "memcpy";
        entry.run = copy;
        registry.cases.push_back(entry);
        entry.subject = "fill";
        entry.run = fill_only;
        registry.cases.push_back(entry);
        entry.subject = "sum";
        entry.run = sum_only;
        registry.cases.push_back(entry);
    }
}

} // namespace tandem::bench
