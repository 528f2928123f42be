// SPDX-License-Identifier: Apache-2.0
// One message at long intervals: when it arrives, the code and data of its path have left the caches.
#pragma once
#include "apps/bench/harness/session.hpp"

#include <algorithm>
#include <pthread.h>
#include <sched.h>
#include <string>
#include <time.h>

namespace tandem::bench {

constexpr int cold_intervals_ms[] = {1, 10, 100};

/// Returns the operation of such a case: "cold-10ms".
inline std::string cold_operation(int interval_ms) { return "cold-" + std::to_string(interval_ms) + "ms"; }
/// Returns whether a case is one of these, including those beside a floor: "paired-cold-10ms", "tail-cold-1ms".
inline bool is_cold(const Case& bench_case) {
    return bench_case.operation.find("cold-") != std::string::npos;
}
/// Returns its interval.
inline int cold_interval_ms(const Case& bench_case) {
    return std::stoi(bench_case.operation.substr(bench_case.operation.find("cold-") + 5));
}

/// Returns how many messages such a case measures: as many as fit into four times the budget's time, at least
/// 20.
inline std::size_t cold_messages(const Budget& budget, int interval_ms) {
    return std::max<std::size_t>(20, static_cast<std::size_t>(4e3 * budget.seconds / interval_ms));
}
/// Messages before the first one that counts.
constexpr std::size_t cold_warm_up = 5;

/// [calling thread] Sets the priority that the components of the bridge's cases have. If it is not permitted,
/// both run without it.
inline void request_priority() {
    const sched_param priority{5};
    pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
}

/// [one thread] Sleeps from the end of one interval to the end of the next.
class ColdPacer {
  public:
    explicit ColdPacer(int interval_ms) : interval_ns_(interval_ms * 1'000'000L) {
        clock_gettime(CLOCK_MONOTONIC, &due_);
    }
    void sleep() {
        const long ns = due_.tv_nsec + interval_ns_;
        due_ = {due_.tv_sec + ns / 1'000'000'000, ns % 1'000'000'000};
        // If the due time has passed, after a stall, the sleep ends at once.
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due_, nullptr) != 0) {
        }
    }

  private:
    long interval_ns_;
    timespec due_{};
};

} // namespace tandem::bench
