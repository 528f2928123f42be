// SPDX-License-Identifier: Apache-2.0
// cyclictest (Debian package rt-tests): the lateness of its thread at a period of 1 ms, in whole
// microseconds, from the histogram that it prints. Kernel developers measure wake-up latency with it. The
// ticks of both hosts are compared with it.
#include "apps/bench/harness/in_process_cases.hpp"
#include "apps/bench/harness/session.hpp"
#include "apps/bench/harness/tick_budget.hpp"
#include "host/process/run_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <sstream>
#include <string>
#include <unistd.h>

namespace tandem::bench {

namespace {

constexpr const char* program = "/usr/bin/cyclictest";
constexpr int histogram_us = 100'000; // wider latencies are only counted

/// Runs it for the same number of ticks as the other tick cases.
void tick(Session& session) {
    const int count = lateness_ticks(session.budget());
    process::CommandOptions options;
    options.timeout = std::chrono::minutes(1) + std::chrono::milliseconds(count);
    options.merge_errors = true;
    // It runs at normal priority (no --priority), like the components of the other tick cases.
    std::istringstream out(
        process::run_command({program, "--quiet", "--threads=1", "--interval=1000",
                              fmt::format("--loops={}", count), fmt::format("--histogram={}", histogram_us)},
                             options)
            .output);
    int late_us = 0, times = 0, seen = 0, max_us = 0, overflows = 0;
    TickCounts counts;
    const auto sample = [&](int us) {
        session.add_result(us * 1e3);
        counts.add(us * std::int64_t{1000}, tick_period_ns);
        ++seen;
    };
    for (std::string text; std::getline(out, text);) {
        const char* const line = text.c_str();
        // "000012 000345": 345 ticks were 12 us late. Lines of the summary begin with '#'.
        if (line[0] != '#' && std::sscanf(line, "%d %d", &late_us, &times) == 2)
            for (int i = 0; i < times && seen < count; ++i) sample(late_us);
        std::sscanf(line, "# Max Latencies: %d", &max_us);
        std::sscanf(line, "# Histogram Overflows: %d", &overflows);
    }
    for (int i = 0; i < overflows && seen < count; ++i)
        sample(max_us); // each counts as late as the latest: cyclictest does not print the lateness of each
    if (seen == 0) throw std::runtime_error("cyclictest printed no histogram");
    session.set_tick_counts(counts);
}

} // namespace

void add_cyclictest_cases(Registry& registry) {
    if (access(program, X_OK) != 0) {
        registry.skipped.push_back({"cyclictest", "not installed: install the Debian package rt-tests"});
        return;
    }
    InProcessCases(registry, Group::peer, "cyclictest").add("tick", sizeof(double), Wake::blocking, tick);
}

} // namespace tandem::bench
