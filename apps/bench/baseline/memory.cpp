// SPDX-License-Identifier: Apache-2.0
// The time that one core needs to copy, fill and sum memory. A stream between two cores fills on one and sums
// on the other, and cannot be faster than the slower of the two.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/measurements/measurements.hpp"

#include <cstring>

namespace tandem::bench {

namespace {

/// Measures windows of repeated work(1), work(2), ... on the case's bytes; results in GB/s.
template <class Work>
void repeat(Session& session, Work&& work) {
    const auto bytes = static_cast<double>(session.bytes());
    const std::uint64_t window = to_ticks(session.budget().window_seconds * 1e9 / 3);
    for (int i = -1; i < session.budget().windows; ++i) { // the first is warm-up
        const std::uint64_t begin = ticks();
        std::uint64_t now = begin, rounds = 0;
        for (; now - begin < window; now = ticks()) work(++rounds);
        if (i >= 0) session.add_result(static_cast<double>(rounds) * bytes / to_ns(now - begin));
    }
}

/// Copies one half of the session's memory to the other.
void copy(Session& session) {
    std::byte* from = session.memory().data();
    std::byte* to = from + session.memory().size() / 2;
    fill_message(from, session.bytes(), 1);
    repeat(session, [&](std::uint64_t) {
        std::memcpy(to, from, session.bytes());
        asm volatile("" ::: "memory"); // otherwise the compiler would drop all copies except the last
    });
    checked_sequence(to, session.bytes());
}

/// The work of a stream's writer, without a reader.
void fill(Session& session) {
    repeat(session,
           [&](std::uint64_t round) { fill_message(session.memory().data(), session.bytes(), round); });
}

/// The work of a stream's reader, without a writer.
void sum(Session& session) {
    fill_message(session.memory().data(), session.bytes(), 1);
    repeat(session, [&](std::uint64_t) {
        asm volatile("" ::: "memory"); // otherwise the compiler would sum only once
        checked_sequence(session.memory().data(), session.bytes());
    });
}

} // namespace

void add_memory_cases(Registry& registry) {
    const auto add = [&](const char* subject, std::size_t bytes, void (*run)(Session&)) {
        registry.add({.group = Group::baseline,
                      .subject = subject,
                      .operation = "stream",
                      .bytes = bytes,
                      .wake = Wake::none,
                      .placement = Placement::alone,
                      .unit = Unit::gigabytes_per_second,
                      .run = run});
    };
    for (std::size_t bytes : {mebibyte, 6 * mebibyte}) {
        add("memcpy", bytes, copy);
        add("fill", bytes, fill);
        add("sum", bytes, sum);
    }
}

} // namespace tandem::bench
