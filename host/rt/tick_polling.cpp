// SPDX-License-Identifier: Apache-2.0
#include "host/rt/tick_polling.hpp"

#include "host/rt/crossings.hpp"
#include "host/rt/rehearsal.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

namespace tandem::rt {
namespace {

constexpr std::int64_t million = 1'000'000;
constexpr std::int64_t default_spin_ns = 100'000;
constexpr std::int64_t default_spin_part = 20; // divisor of the period: upper limit
constexpr std::int64_t max_wake_up_part = 10;  // divisor of the period: upper limit
constexpr std::int64_t share_limit = million / 10;
std::atomic<std::int64_t> share_sum{0}; // of all ticks of the process; in millionths of a processor

constexpr std::int64_t review_interval_ns = 250'000'000;
// How long, and for how many periods, a tick continues to poll without new messages.
constexpr std::int64_t patience_ns = 1'000'000'000;
constexpr std::int64_t patience_periods = 8;

std::int64_t default_spin(std::int64_t period) {
    return std::min(default_spin_ns, period / default_spin_part);
}

} // namespace

TickPolling::TickPolling(std::optional<std::chrono::nanoseconds> spin, std::int64_t period,
                         std::function<void()> rehearse)
    : by_default_(!spin), period_(period), spin_(spin ? spin->count() : default_spin(period)),
      rehearse_(std::move(rehearse)) {}

TickPolling::~TickPolling() { give_share_back(); }

void TickPolling::rehearse() const {
    const Rehearsal rehearsal;
    rehearse_();
}

void TickPolling::review(std::int64_t now) {
    if (!by_default_ || !rehearse_ || now - reviewed_ < review_interval_ns) return;
    if (!messages_cross(now))
        give_share_back();
    else if (share_ == 0)
        take_share();
    else
        update_share(now);
    polled_ = 0;
    reviewed_ = now;
}

bool TickPolling::messages_cross(std::int64_t now) {
    this_thread_crossings = 0;
    rehearse();
    if (crossed_ != this_thread_crossings) used_ = now;
    crossed_ = this_thread_crossings;
    return used_ != 0 && now - used_ <= std::max(patience_ns, patience_periods * period_);
}

void TickPolling::take_share() {
    const std::int64_t share = spin_ * million / period_;
    if (share_sum.fetch_add(share) + share <= share_limit)
        share_ = share;
    else
        share_sum.fetch_sub(share);
}

/// Replaces the estimated share by the measured one. A thread whose wake-up was short also polls for the rest of the time that
/// was reserved for the wake-up. A share that is larger than estimated only keeps further ticks from polling.
void TickPolling::update_share(std::int64_t now) {
    const std::int64_t share = std::max<std::int64_t>(polled_ * million / (now - reviewed_), 1);
    share_sum.fetch_add(share - std::exchange(share_, share));
}

void TickPolling::give_share_back() { share_sum.fetch_sub(std::exchange(share_, 0)); }

// A thread that is waking up does not use its processor.
std::int64_t TickPolling::lead() const {
    if (!by_default_) return spin_;
    return share_ == 0 ? 0 : spin_ + wake_up_;
}

/// A longer wake-up counts at once, because the next long wake-up would leave no time for the rehearsal. A shorter
/// wake-up counts gradually.
void TickPolling::note_wake_up(std::int64_t delay) {
    wake_up_ =
        delay > wake_up_ ? std::min(delay, period_ / max_wake_up_part) : wake_up_ - (wake_up_ - delay) / 16;
}

} // namespace tandem::rt
