// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/machine/clock.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <thread>

namespace tandem::bench {

namespace {

/// constant_tsc: the rate does not depend on the core's frequency. nonstop_tsc: the counter continues in deep
/// idle states.
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

/// One moment on both clocks.
struct ClockReadings {
    std::uint64_t ns, ticks;
};

/// Reads CLOCK_MONOTONIC_RAW between two readings of the counter. The shortest of 50 such triples counts,
/// because an interrupt within a triple would shift the readings against each other.
ClockReadings read_both_clocks() {
    ClockReadings best{};
    std::uint64_t tightest = ~std::uint64_t{0};
    for (int i = 0; i < 50; ++i) {
        const std::uint64_t before = ticks();
        const std::uint64_t ns = raw_ns();
        const std::uint64_t after = ticks();
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
    // 100 ms: an error of 20 ns at each end is then 0.4 ppm.
    const ClockReadings from = read_both_clocks();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const ClockReadings to = read_both_clocks();
    ns_per_tick = static_cast<double>(to.ns - from.ns) / static_cast<double>(to.ticks - from.ticks);
}

std::string Clock::name() {
    return tsc ? fmt::format("rdtsc+lfence, {:.3f} GHz", 1.0 / ns_per_tick) : "CLOCK_MONOTONIC_RAW";
}

} // namespace tandem::bench
