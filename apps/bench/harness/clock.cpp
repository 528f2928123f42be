// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/clock.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace tandem::bench {

namespace {

/// Both flags: it ticks at one rate, and goes on in deep sleep.
bool invariant_tsc() {
#ifdef __x86_64__
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.rfind("flags", 0) == 0)
            return line.find(" constant_tsc") != std::string::npos &&
                   line.find(" nonstop_tsc") != std::string::npos;
#endif
    return false;
}

struct ClockReadings {
    std::uint64_t ns, ticks;
};

/// The tightest of several pairs of readings, so that an interruption between the two does not count.
ClockReadings read_both_clocks() {
    ClockReadings best{};
    std::uint64_t tightest = ~std::uint64_t{0};
    for (int i = 0; i < 50; ++i) {
        const std::uint64_t before = ticks(), ns = raw_ns(), after = ticks();
        if (after - before < tightest) {
            tightest = after - before;
            best = {ns, before + (after - before) / 2};
        }
    }
    return best;
}

} // namespace

void Clock::calibrate() {
    tsc = invariant_tsc();
    ns_per_tick = 1.0;
    if (!tsc) return;
    const ClockReadings from = read_both_clocks();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const ClockReadings to = read_both_clocks();
    ns_per_tick = static_cast<double>(to.ns - from.ns) / static_cast<double>(to.ticks - from.ticks);
}

std::string Clock::name() {
    return tsc ? fmt::format("rdtsc+lfence, {:.3f} GHz", 1.0 / ns_per_tick) : "CLOCK_MONOTONIC_RAW";
}

} // namespace tandem::bench
