// SPDX-License-Identifier: Apache-2.0
#include "host/rt/periodic_tick.hpp"

#include "host/rt/cycle_lines.hpp"
#include "shm/os/processor.hpp"

#include <algorithm>
#include <climits>
#include <ctime>
#include <linux/futex.h>
#include <stdexcept>
#include <string>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace tandem::rt {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

// Sleeps until an absolute time of CLOCK_MONOTONIC, but only while `interrupted` is 0: a relative sleep would add the time
// between reading the clock and sleeping to every period.
void sleep_until(std::int64_t when, std::atomic<std::uint32_t>& interrupted) {
    const timespec at{static_cast<time_t>(when / second_ns), static_cast<long>(when % second_ns)};
    syscall(SYS_futex, &interrupted, FUTEX_WAIT_BITSET_PRIVATE, 0, &at, nullptr, FUTEX_BITSET_MATCH_ANY);
}

// Tells the processor that this is a polling loop. This saves power and leaves the core to its other hyper-thread.
void relax() { shm::Processor::pause(); }

// The rehearsal is repeated between these two times before a tick, while the time left is at least twice the last
// rehearsal.
constexpr std::int64_t repeat_from_ns = 100'000;
constexpr std::int64_t repeat_to_ns = 2'000;

} // namespace

std::int64_t monotonic_ns() noexcept {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * second_ns + now.tv_nsec;
}

std::int64_t next_on_grid(std::int64_t now, std::int64_t period, std::int64_t phase) noexcept {
    // The outer modulo makes the remainder positive when `now` is before the phase.
    const std::int64_t origin = grid_origin.count() + phase,
                       into_period = ((now - origin) % period + period) % period;
    return now - into_period + period;
}

PeriodicTick::PeriodicTick(const TickOptions& options)
    : slot_(options.name,
            options.period.count() > 0 ? static_cast<std::uint64_t>(options.period.count()) : 1),
      period_(options.period.count()), aligned_(options.aligned), phase_(options.phase.count()),
      polling_(options.spin, period_, options.rehearse) {
    if (period_ <= 0)
        throw std::invalid_argument("a periodic tick needs a period above 0 ns, got " +
                                    std::to_string(period_));
}

void PeriodicTick::plan_first(std::int64_t now) {
    started_ = true;
    next_ = aligned_ ? next_on_grid(now, period_, phase_) : now;
}

std::uint64_t PeriodicTick::plan_next(std::int64_t now) {
    next_ += period_;
    if (now <= next_) return 0; // on time
    // The tick is already due. Drops the ticks of whole periods that have passed.
    count(slot_->overruns);
    const std::int64_t missed = (now - next_) / period_;
    next_ += missed * period_;
    count(slot_->skipped, static_cast<std::uint64_t>(missed));
    return static_cast<std::uint64_t>(missed);
}

/// Repeats the rehearsal, because the processor's branch prediction learns gradually, and because the caches must still
/// hold everything when the tick comes. Returns the current time.
std::int64_t PeriodicTick::poll_until_next(std::int64_t now) {
    std::int64_t took = 0; // duration of the last rehearsal; 0: there was none
    while (now < next_ && !interrupted()) {
        const std::int64_t begin = now, left = next_ - now;
        const bool again = left < repeat_from_ns && left > std::max(repeat_to_ns, 2 * took);
        const bool rehearses = polling_.can_rehearse() && (took == 0 || again);
        if (rehearses) polling_.rehearse();
        relax();
        now = monotonic_ns();
        if (rehearses) took = std::max<std::int64_t>(now - begin, 1);
    }
    return now;
}

void PeriodicTick::sleep_until_next() {
    // Three phases: sleep, rehearse, poll.
    polling_.review(monotonic_ns());
    const std::int64_t poll_from = next_ - polling_.lead();
    std::int64_t now = monotonic_ns();
    const bool sleeps = now < poll_from;
    while (now < poll_from && !interrupted()) {
        sleep_until(poll_from, interrupted_);
        now = monotonic_ns();
    }
    if (sleeps && now >= poll_from) polling_.note_wake_up(now - poll_from);
    const std::int64_t woken = now;
    now = poll_until_next(now);
    polling_.note_polled(now - woken);
    began_ = now;
    note_lateness(now - next_);
}

void PeriodicTick::note_lateness(std::int64_t lateness) {
    // This thread is the only writer, so no compare-and-exchange is needed.
    std::atomic_ref(slot_->lateness_ns_last).store(lateness, std::memory_order_relaxed);
    if (lateness > slot_->lateness_ns_max)
        std::atomic_ref(slot_->lateness_ns_max).store(lateness, std::memory_order_relaxed);
    if (slot_.is_public() && !interrupted()) count(slot_->lateness[time_octave(lateness)]);
}

void PeriodicTick::note_due(std::int64_t when) {
    if (slot_.is_public()) std::atomic_ref(slot_->due_ns).store(when, std::memory_order_relaxed);
}

void PeriodicTick::note_lines() const {
    rt::note_lines(this, CycleLines::line);
    rt::note_lines(slot_.operator->(), CycleLines::line);
}

void PeriodicTick::note_execution(std::int64_t took) {
    if (took > slot_->execution_ns_max)
        std::atomic_ref(slot_->execution_ns_max).store(took, std::memory_order_relaxed);
    if (slot_.is_public()) count(slot_->execution[time_octave(took)]);
}

void PeriodicTick::begin_cycle() {
    began_ = monotonic_ns();
    note_due(began_ + period_);
}

void PeriodicTick::rest() {
    began_ = 0;
    note_due(0);
}

void PeriodicTick::interrupt() noexcept {
    interrupted_.store(1);
    syscall(SYS_futex, &interrupted_, FUTEX_WAKE_PRIVATE, INT_MAX, nullptr, nullptr, 0);
}

std::uint64_t PeriodicTick::wait() {
    if (interrupted()) {
        rest();
        return 0;
    }
    const std::int64_t now = monotonic_ns();
    if (began_ != 0) note_execution(now - std::exchange(began_, 0));
    std::uint64_t missed = 0;
    if (started_)
        missed = plan_next(now);
    else
        plan_first(now);
    note_due(next_);
    sleep_until_next();
    note_due(interrupted() ? 0 : next_ + period_);
    if (!interrupted()) count(slot_->ticks);
    return missed;
}

void PeriodicTick::tick_at(const ArrivedTick& tick) {
    const std::int64_t missed = started_ ? (tick.planned - next_) / period_ - 1 : 0;
    if ((started_ && tick.overran) || missed > 0) count(slot_->overruns);
    if (missed > 0) count(slot_->skipped, static_cast<std::uint64_t>(missed));
    started_ = true;
    next_ = tick.planned;
    if (tick.took > 0) note_execution(tick.took);
    note_lateness(tick.now - tick.planned);
    note_due(interrupted() ? 0 : tick.planned + period_);
    if (!interrupted()) count(slot_->ticks);
}

TickStats PeriodicTick::stats() const {
    const auto value = [](auto& counter) { return std::atomic_ref(counter).load(std::memory_order_relaxed); };
    return {value(slot_->ticks), value(slot_->overruns), value(slot_->skipped),
            value(slot_->lateness_ns_last), value(slot_->lateness_ns_max)};
}

} // namespace tandem::rt
