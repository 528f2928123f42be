// SPDX-License-Identifier: Apache-2.0
// The physical limit: the cost of reading the clock, and the time that one modified cache line takes from core
// to core. No transport between two cores is faster than the latter.
#include "apps/bench/baseline/line_endpoint.hpp"
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/registry.hpp"
#include "apps/bench/measurements/measurements.hpp"

namespace tandem::bench {

namespace {

/// Part of every latency in the report: the clock is read once before and once after.
void read_clock(Session& session) {
    session.begin_measuring();
    while (session.needs_more()) {
        const std::uint64_t before = ticks();
        const std::uint64_t after = ticks();
        session.add_sample(after - before, after);
    }
    session.end_measuring();
}

} // namespace

void add_cache_line_cases(Registry& registry) {
    Case line;
    line.group = Group::baseline;
    line.subject = "cache-line";
    line.operation = "one-way";
    line.bytes = 8;
    line.divisor = 2;
    line.run = measure_round_trips<LineEndpoint>;
    registry.add(line);
    line.placement = Placement::threads;
    registry.add(line);

    Case clock;
    clock.group = Group::baseline;
    clock.subject = "clock";
    clock.operation = "read";
    clock.bytes = 0;
    clock.wake = Wake::none;
    clock.placement = Placement::alone;
    clock.run = read_clock;
    registry.add(clock);
}

} // namespace tandem::bench
