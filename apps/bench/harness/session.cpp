// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/session.hpp"

#include <chrono>
#include <thread>

namespace tandem::bench {

void Session::arrive_and_wait() {
    if (case_.placement == Placement::alone) return;
    const std::uint32_t all = 2 * ++met_;
    control_.arrived.fetch_add(1, std::memory_order_acq_rel);
    // The driver bounds it: it kills both if one of them does not come.
    while (control_.arrived.load(std::memory_order_acquire) < all)
        std::this_thread::sleep_for(std::chrono::microseconds(100));
}

void Session::begin(std::size_t count, double seconds, bool keep) {
    taken_ = 0;
    wanted_ = count;
    keep_ = keep;
    last_ = ticks();
    end_ = last_ + to_ticks(seconds * 1e9);
}

void Session::add_result(double value) {
    const std::size_t at = control_.sample_count.load(std::memory_order_relaxed);
    control_.samples()[at] = value;
    control_.sample_count.store(at + 1, std::memory_order_release);
}

} // namespace tandem::bench
