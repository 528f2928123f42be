// SPDX-License-Identifier: Apache-2.0
// cyclictest (Debian package rt-tests): the lateness of its thread at a period of 1 ms, from its histogram of
// whole microseconds.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/session.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <unistd.h>

namespace tandem::bench {

namespace {

constexpr const char* program = "/usr/bin/cyclictest";
constexpr int widest_us = 100'000;
constexpr std::int64_t period_ns = 1'000'000;

void tick(Session& session) {
    const int count = session.budget().samples >= 50'000 ? 10'000 : 1'000;
    const std::string command = fmt::format(
        "{} --quiet --threads=1 --interval=1000 --loops={} --histogram={} 2>&1", program, count, widest_us);
    const std::unique_ptr<FILE, int (*)(FILE*)> out(popen(command.c_str(), "re"), pclose);
    if (!out) throw std::runtime_error("cannot start cyclictest");
    char line[256];
    int late_us = 0, times = 0, seen = 0, latest_us = 0, beyond = 0;
    TickCounts counts;
    const auto sample = [&](int us) {
        session.add_result(us * 1e3);
        counts.add(us * std::int64_t{1000}, period_ns);
        ++seen;
    };
    while (std::fgets(line, sizeof line, out.get()) != nullptr) {
        if (line[0] != '#' && std::sscanf(line, "%d %d", &late_us, &times) == 2)
            for (int i = 0; i < times && seen < count; ++i) sample(late_us);
        std::sscanf(line, "# Max Latencies: %d", &latest_us);
        std::sscanf(line, "# Histogram Overflows: %d", &beyond);
    }
    for (int i = 0; i < beyond && seen < count; ++i) sample(latest_us); // wider than the histogram
    if (seen == 0) throw std::runtime_error("cyclictest printed no histogram");
    session.set_tick_counts(counts);
}

} // namespace

void add_cyclictest_cases(Registry& registry) {
    if (access(program, X_OK) != 0) {
        registry.skipped.push_back({"cyclictest", "not installed: Debian package rt-tests"});
        return;
    }
    Case entry;
    entry.group = Group::peer;
    entry.subject = "cyclictest";
    entry.operation = "tick";
    entry.placement = Placement::alone;
    entry.wake = Wake::blocking;
    entry.bytes = sizeof(double);
    entry.run = tick;
    registry.cases.push_back(entry);
}

} // namespace tandem::bench
