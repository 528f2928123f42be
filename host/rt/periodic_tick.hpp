// SPDX-License-Identifier: Apache-2.0
// A periodic tick on CLOCK_MONOTONIC: the clock of every executor of both hosts.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace tandem::rt {

/// Where on CLOCK_MONOTONIC the grid of all aligned ticks begins. The kernel's own timer tick falls on whole
/// multiples of its period (1 to 10 ms; so aligned since Linux 6.3), and takes tens of us on a virtual machine:
/// ticks of whole milliseconds would all wait for it. This is far from it for periods down to 250 us.
inline constexpr std::chrono::nanoseconds grid_origin{375'000};

struct TickOptions {
    std::chrono::nanoseconds period;
    std::chrono::nanoseconds phase{0};
    /// Ticks fall on grid_origin plus multiples of the period plus the phase, so that two hosts share one grid
    /// without talking. Otherwise the grid starts at the first wait(), whose tick comes at once.
    bool aligned = true;
    /// The last stretch before a tick is polled instead of slept.
    std::chrono::nanoseconds spin{0};
    /// [tick-thread] Called when the polling begins, if there is any: goes the way that the tick will go, as
    /// far as that does nothing, so that its code and data are in the caches again when the time comes.
    std::function<void()> warm_up{};
};

struct TickStats {
    std::uint64_t ticks;    ///< waits that ended in a tick
    std::uint64_t overruns; ///< ticks whose time had passed when wait() was called
    std::uint64_t skipped;  ///< periods that never got a tick
    std::int64_t lateness_ns_last;
    std::int64_t lateness_ns_max;
};

class PeriodicTick {
  public:
    /// Throws std::invalid_argument unless period > 0.
    explicit PeriodicTick(const TickOptions& options);

    /// [tick-thread] Sleeps to the next tick and returns how many periods were skipped because the work
    /// overran. A tick late by less than one period comes at once; older ones are dropped and the grid is
    /// kept.
    std::uint64_t wait();

    /// [any-thread] Makes the wait under way, and all later ones, return within 100 ms without a tick.
    void interrupt() noexcept { interrupted_.store(true, std::memory_order_relaxed); }
    bool interrupted() const noexcept { return interrupted_.load(std::memory_order_relaxed); }

    /// [tick-thread] The time the present tick was planned for, in ns of CLOCK_MONOTONIC.
    std::int64_t planned_ns() const noexcept { return next_; }

    /// [any-thread]
    TickStats stats() const;

  private:
    void plan_first(std::int64_t now);
    std::uint64_t plan_next(std::int64_t now);
    void sleep_until_next();

    const std::int64_t period_;
    const std::int64_t phase_; // from the clock's beginning
    const std::int64_t spin_;
    const bool aligned_;
    const std::function<void()> warm_up_;
    bool started_ = false;
    std::int64_t next_ = 0;
    std::atomic<bool> interrupted_{false};
    std::atomic<std::uint64_t> ticks_{0}, overruns_{0}, skipped_{0};
    std::atomic<std::int64_t> lateness_last_{0}, lateness_max_{0};
};

/// Now, in ns of CLOCK_MONOTONIC.
std::int64_t monotonic_ns() noexcept;

/// For a warm_up: the first 2 KiB of an object with virtual functions, for writing, and the table of those.
template <class Object>
void prefetch(const Object& object) {
    constexpr std::size_t line = 64, bytes = 2048;
    const auto* whole = static_cast<const std::byte*>(dynamic_cast<const void*>(&object));
    const auto* functions = *reinterpret_cast<const std::byte* const*>(whole);
    for (std::size_t at = 0; at < bytes; at += line) {
        __builtin_prefetch(whole + at, 1); // a prefetch beyond the end does nothing
        __builtin_prefetch(functions + at);
    }
}

} // namespace tandem::rt
