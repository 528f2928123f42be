// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/session.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace tandem::bench {

void Session::arrive_and_wait() {
    if (case_.placement == Placement::alone) return;
    const std::uint32_t all = 2 * ++barriers_;
    control_.arrivals.fetch_add(1, std::memory_order_acq_rel);
    // No timeout here: the driver kills both sides if one of them does not arrive. Sleeps, because on one core
    // a polling side would hold up the other.
    while (control_.arrivals.load(std::memory_order_acquire) < all)
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
    const std::size_t index = control_.sample_count.load(std::memory_order_relaxed);
    control_.samples()[index] = value;
    control_.sample_count.store(index + 1, std::memory_order_release);
}

void Session::set_path(const PathCounts& counts, const std::vector<std::string>& functions) {
    std::string listing;
    for (const std::string& function : functions) {
        if (listing.size() + function.size() + 2 > Control::listing_bytes) break;
        listing += function + "\n";
    }
    std::copy(listing.begin(), listing.end(), control_.path_functions); // zeros follow it
    control_.path_counts = counts;
    control_.has_path_counts = true;
}

} // namespace tandem::bench
