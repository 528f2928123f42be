// SPDX-License-Identifier: Apache-2.0
// A periodic tick on CLOCK_MONOTONIC. Every periodic executor (OPRoS) and execution context (RTM) waits on one.
#pragma once

#include "host/rt/tick_page.hpp"
#include "host/rt/tick_polling.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace tandem::rt {

/// Offset of all aligned ticks on CLOCK_MONOTONIC. Since Linux 6.3, the kernel's own timer tick falls on whole multiples of
/// its period (1 to 10 ms). It takes tens of us on a virtual machine, and a tick on a whole millisecond would wait for it.
/// The offset keeps ticks with periods down to 250 us apart from it.
inline constexpr std::chrono::nanoseconds grid_origin{375'000};

/// When a PeriodicTick ticks and how it waits.
struct TickOptions {
    std::chrono::nanoseconds period;
    std::chrono::nanoseconds phase{0}; ///< shifts the ticks of this object on the common grid
    /// If set, ticks fall on grid_origin + phase + multiples of the period: two processes share one grid without
    /// communicating. Otherwise the grid starts at the first wait(), which returns at once.
    bool aligned = true;
    /// Time before each tick in which the thread polls the clock instead of sleeping. Default (nullopt): 100 us, but at most
    /// a twentieth of the period, and only while messages cross that a rehearsal has reached (TickPolling). The sleep then
    /// ends earlier by the duration of this thread's recent wake-ups (20 to 100 us on virtual machines), but at most by a
    /// tenth of the period.
    std::optional<std::chrono::nanoseconds> spin = std::chrono::nanoseconds(0);
    /// Is called as a Rehearsal (rehearsal.hpp) when polling begins, and repeatedly in the last 100 us before the tick while
    /// time permits. By default also a few times a second, to see whether messages cross. [tick-thread]
    std::function<void()> rehearse{};
    /// The owner of the ticks, for observers outside the process (tick_page.hpp).
    std::string name{};
};

/// A tick that another object has waited for. Times in ns of CLOCK_MONOTONIC.
struct ArrivedTick {
    std::int64_t planned, now;
    bool overran = false;  ///< the cycle of the tick before ended after this one was due
    std::int64_t took = 0; ///< duration of the cycle of the tick before; 0: there was none
};

/// Counters of a PeriodicTick since its construction.
struct TickStats {
    std::uint64_t ticks;           ///< calls of wait() that ended with a tick
    std::uint64_t overruns;        ///< ticks that were already due when the cycle before ended
    std::uint64_t skipped;         ///< periods without a tick, because the work before took too long
    std::int64_t lateness_ns_last; ///< from the planned time to the return of wait()
    std::int64_t lateness_ns_max;
};

/// Owned by the thread that ticks; other threads may call interrupt() and stats().
class PeriodicTick {
  public:
    /// Throws std::invalid_argument unless period > 0.
    explicit PeriodicTick(const TickOptions& options);
    PeriodicTick(const PeriodicTick&) = delete;
    PeriodicTick& operator=(const PeriodicTick&) = delete;

    /// Waits for the next tick and returns the number of skipped periods. If the work since the last tick took too long, a
    /// tick late by less than one period comes at once, and older ticks are skipped. The grid does not change. [tick-thread]
    std::uint64_t wait();

    /// Counts a tick that another object has waited for. Reads no clock. [tick-thread]
    void tick_at(const ArrivedTick& tick);

    /// Reports the lines that tick_at() uses (cycle_lines.hpp). [tick-thread]
    void note_lines() const;

    /// Reports that a cycle begins without wait(): the first cycle after rest(). [tick-thread]
    void begin_cycle();
    /// Reports that no tick is due until the next wait() or begin_cycle(). [tick-thread]
    void rest();
    /// Returns the memory in which the thread's callbacks are published for readers outside the process. NULL: there are
    /// none, because the page has no slot for this tick.
    crash::CallbackText* callback_text() const { return slot_.is_public() ? &slot_->callback : nullptr; }

    /// Makes the current and all later calls of wait() return at once without a tick. [any-thread]
    void interrupt() noexcept;
    bool interrupted() const noexcept { return interrupted_.load(std::memory_order_relaxed) != 0; }

    /// Returns the planned time of the current tick, in ns of CLOCK_MONOTONIC. [tick-thread]
    std::int64_t planned_ns() const noexcept { return next_; }

    /// Returns the counters. Each counter is exact, but together they are not a snapshot. [any-thread]
    TickStats stats() const;

  private:
    void plan_first(std::int64_t now);
    std::uint64_t plan_next(std::int64_t now);
    void sleep_until_next();
    std::int64_t poll_until_next(std::int64_t now);
    void note_lateness(std::int64_t lateness);
    void note_due(std::int64_t when);
    void note_execution(std::int64_t took);

    // First what tick_at() needs, in one cache line.
    const OwnTickSlot slot_;
    const std::int64_t period_;
    std::int64_t next_ = 0;                     // planned time of the coming, then of the current tick
    std::int64_t began_ = 0;                    // when the current cycle did; 0: there is none
    std::atomic<std::uint32_t> interrupted_{0}; // a futex
    bool started_ = false;
    const bool aligned_;
    const std::int64_t phase_; // from grid_origin; all times in ns
    TickPolling polling_;
};

/// Returns CLOCK_MONOTONIC in ns. [any-thread]
std::int64_t monotonic_ns() noexcept;

/// Returns the first tick of the grid of aligned ticks after `now`. All times in ns. [any-thread]
std::int64_t next_on_grid(std::int64_t now, std::int64_t period, std::int64_t phase) noexcept;

/// Time after which a rehearsal starts with no further port, so that a component with many ports is not late for its tick.
inline constexpr std::int64_t rehearsal_limit_ns = 50'000;

/// Prefetches the first 2 KiB of an object with virtual functions, for writing, and its table of virtual
/// functions. For TickOptions::rehearse; reads only the table pointer of the object.
template <class Object>
void prefetch(const Object& object) {
    constexpr std::size_t line = 64, bytes = 2048;
    const auto* whole = static_cast<const std::byte*>(dynamic_cast<const void*>(&object));
    const auto* functions = *reinterpret_cast<const std::byte* const*>(whole);
    for (std::size_t at = 0; at < bytes; at += line) {
        __builtin_prefetch(whole + at, 1); // a prefetch of an invalid address has no effect
        __builtin_prefetch(functions + at);
    }
    std::atomic_signal_fence(std::memory_order_seq_cst); // as in CycleLines::prefetch()
}

} // namespace tandem::rt
