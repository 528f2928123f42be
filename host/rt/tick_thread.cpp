// SPDX-License-Identifier: Apache-2.0
#include "host/rt/tick_thread.hpp"

#include "host/process/start_thread.hpp"
#include "host/rt/periodic_tick.hpp"
#include "host/rt/rehearsal.hpp"

#include <algorithm>
#include <chrono>
#include <sys/resource.h>

namespace tandem::rt {
namespace {

constexpr std::int64_t ms = 1'000'000;
// A cycle that takes longer than this part of the period, or than this time, delays others too much.
constexpr std::int64_t share_part = 4, longest_share = ms;
constexpr int slow_cycles_in_a_row = 3;
// Each member records the cache lines of its cycle again after this number of rounds.
constexpr std::size_t rounds_per_note = 64;
// A cycle hangs if it takes longer than the period, within these limits.
constexpr std::int64_t shortest_hang = 20 * ms, longest_hang = 100 * ms;

long count_waits() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_nvcsw;
}

std::chrono::steady_clock::time_point time_point(std::int64_t monotonic) {
    return std::chrono::steady_clock::time_point(std::chrono::nanoseconds(monotonic));
}

} // namespace

void TickThread::start() {
    const Lock lock(mutex); // leave() finds `thread` set
    thread = process::start_thread([self = shared_from_this()] { self->run(); });
}

bool TickThread::rests() const {
    return std::all_of(members.begin(), members.end(), [](const auto& each) { return each->rests_; });
}

bool TickThread::delays_members() const {
    return members.size() > 1 || (running != nullptr && !members.empty() && members.front().get() != running);
}

void TickThread::add(const std::shared_ptr<SharedTick>& tick) {
    members.push_back(tick);
    tick->thread_ = shared_from_this();
    has_woken = has_woken || (tick->rests_ && tick->woken_);
    changed.notify_all();
}

void TickThread::remove(const SharedTick& tick) {
    const auto found =
        std::find_if(members.begin(), members.end(), [&](const auto& each) { return each.get() == &tick; });
    if (found == members.end()) return;
    if (found - members.begin() < static_cast<std::ptrdiff_t>(next)) --next;
    members.erase(found);
    changed.notify_all();
}

bool TickThread::hangs(std::int64_t now) {
    const std::int64_t limit = std::clamp<std::int64_t>(options.period.count(), shortest_hang, longest_hang);
    const bool is_second_look = running != nullptr && looked_at == running_since;
    looked_at = running != nullptr ? running_since : 0;
    return is_second_look && delays_members() && now - running_since > limit;
}

void TickThread::plan_next() {
    const std::int64_t period = options.period.count(), now = monotonic_ns();
    planned += period;
    if (now > planned) planned += (now - planned) / period * period; // the periods between have no tick
}

void TickThread::run() {
    const auto notices = configure_this_thread(options.thread);
    Lock lock(mutex);
    id = std::this_thread::get_id();
    if (!members.empty())
        for (const std::string& notice : notices) members.front()->work_.log(notice);
    const auto must_act = [this] { return has_woken || members.empty(); };
    bool has_rested = true;
    while (!members.empty()) {
        if (has_woken) {
            run_round(lock, false);
        } else if (rests()) {
            changed.wait(lock, [&] { return must_act() || !rests(); });
            has_rested = true;
        } else {
            if (has_rested)
                planned = next_on_grid(monotonic_ns(), options.period.count(), options.phase.count());
            has_rested = false;
            if (changed.wait_until(lock, time_point(planned), must_act)) continue;
            run_round(lock, true);
            plan_next();
        }
    }
    if (thread.joinable()) thread.detach(); // nobody waits for it
}

/// Runs the cycles that are due, or without `all` only those of members that were woken from their rest.
void TickThread::run_round(Lock& lock, bool all) {
    has_woken = false;
    waits = count_waits();
    std::int64_t now = monotonic_ns();
    rounds += all ? 1 : 0;
    for (next = 0; next < members.size();) {
        const auto tick = members[next++];
        if (!(tick->rests_ ? tick->woken_ : all)) continue;
        prefetch_following();
        run_cycle(lock, tick, now);
    }
}

/// Requests the lines of the next cycle, and the object with the lines of the one after it.
void TickThread::prefetch_following() const {
    constexpr std::size_t counters = 2 * sizeof(void*); // std::make_shared() puts them before the object
    if (next < members.size()) members[next]->lines_.prefetch();
    if (next + 1 >= members.size()) return;
    const SharedTick& tick = *members[next + 1];
    const auto* at = reinterpret_cast<const std::byte*>(&tick) - counters;
    // The cycle is the last member that is used here.
    for (const void* const end = &tick.work_.cycle + 1; at < end; at += CycleLines::line)
        __builtin_prefetch(at, 1);
}

void TickThread::note_lines(SharedTick& tick) {
    tick.lines_.clear();
    this_thread_lines = &tick.lines_;
    {
        const Rehearsal rehearsal;
        tick.work_.rehearse();
    }
    this_thread_lines = nullptr;
}

/// Runs one cycle, which begins `now` or after its rehearsal, and sets `now` to its end.
void TickThread::run_cycle(Lock& lock, const std::shared_ptr<SharedTick>& tick, std::int64_t& now) {
    tick->woken_ = false;
    running = tick.get();
    running_since = now;
    const bool notes_lines = tick->work_.rehearse && !tick->rests_ && (rounds + next) % rounds_per_note == 0;
    lock.unlock();
    if (notes_lines) {
        note_lines(*tick);
        now = monotonic_ns(); // the rehearsal is not part of the cycle
    }
    const std::int64_t began = now;
    const auto after = tick->work_.cycle({planned, began, tick->overran_, tick->took_});
    now = monotonic_ns();
    const std::int64_t took = now - began;
    lock.lock();
    running = nullptr;
    tick->took_ = took;
    tick->overran_ = now >= planned + options.period.count();
    tick->rests_ = after == SharedTick::Next::rest;
    has_woken = has_woken || (tick->rests_ && tick->woken_);
    if (tick->left_) changed.notify_all(); // leave() waits
    const bool is_slow = !tick->left_ && members.size() > 1 && takes_too_long(*tick, took);
    if (!is_slow && !tick->next_options_) return;
    lock.unlock();
    {
        TickThreads& threads = TickThreads::all();
        const Lock all(threads.mutex);
        if (is_slow)
            threads.separate(tick, took);
        else
            threads.apply_change(tick);
    }
    now = monotonic_ns();
    lock.lock();
}

/// A thread that has waited was not merely kept from its processor by other threads.
bool TickThread::takes_too_long(SharedTick& tick, std::int64_t took) {
    if (took <= std::min(options.period.count() / share_part, longest_share)) {
        tick.slow_cycles_ = 0;
        return false;
    }
    const long until_now = count_waits();
    const bool has_waited = std::exchange(waits, until_now) != until_now;
    return has_waited || ++tick.slow_cycles_ >= slow_cycles_in_a_row;
}

} // namespace tandem::rt
