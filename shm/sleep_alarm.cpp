// SPDX-License-Identifier: Apache-2.0
#include "shm/sleep_alarm.hpp"

#include <climits>
#include <csignal>

namespace tandem::shm {

SleepAlarm& SleepAlarm::of_process() {
    static SleepAlarm alarm;
    return alarm;
}

SleepAlarm::SleepAlarm() {
    pthread_atfork(nullptr, nullptr, [] { of_process().forget_thread(); });
}

SleepAlarm::~SleepAlarm() {
    const bool runs = state_.exchange(State::refused) == State::runs;
    stop_.store(true);
    nudge();
    if (runs) pthread_join(thread_, nullptr);
}

/// The sleepers are not here either: only the thread that forked is.
void SleepAlarm::forget_thread() {
    pthread_mutex_init(&starting_, nullptr); // its holder may not be here
    for (Slot& slot : slots_) {
        slot.deadline.store(never);
        slot.word.store(nullptr);
    }
    next_.store(never);
    state_.store(State::unborn);
}

bool SleepAlarm::start() {
    pthread_mutex_lock(&starting_);
    if (state_.load() == State::unborn) {
        sigset_t all, before;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before); // the program's signals are for the program's threads
        const auto run = [](void* alarm) -> void* {
            static_cast<SleepAlarm*>(alarm)->run();
            return nullptr;
        };
        const bool born = pthread_create(&thread_, nullptr, run, this) == 0;
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
        if (born) pthread_setname_np(thread_, "tandem-alarm");
        state_.store(born ? State::runs : State::refused);
    }
    pthread_mutex_unlock(&starting_);
    return state_.load() == State::runs;
}

// Two sides' words crossing, all seq_cst (as in futex.hpp):
//
//     sleeper: slot.deadline = d | next_ > d ?            alarm: next_ = n | look at the slots: d < n ?
//
// At least one of the two sees the other: the alarm goes to sleep for d, or the sleeper nudges it.
bool SleepAlarm::sleep(std::atomic<std::uint32_t>& word, std::uint32_t expected, std::uint64_t deadline) {
    if (state_.load(std::memory_order_acquire) != State::runs && !start()) return false;
    // One word has one sleeper, as a rule, and so finds its slot free, and in its core's cache.
    const auto hash = reinterpret_cast<std::uintptr_t>(&word) / 64 % slots_.size();
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        Slot& slot = slots_[(hash + i) % slots_.size()];
        std::atomic<std::uint32_t>* nobody = nullptr;
        if (!slot.word.compare_exchange_strong(nobody, &word, std::memory_order_acquire)) continue;
        slot.deadline.store(deadline);
        if (next_.load() > deadline) nudge();
        futex_wait_forever(word, expected);
        slot.deadline.store(never, std::memory_order_relaxed);
        slot.word.store(nullptr, std::memory_order_release);
        return true;
    }
    return false;
}

void SleepAlarm::nudge() {
    nudges_.fetch_add(1);
    futex_wake(nudges_, 1);
}

void SleepAlarm::run() {
    while (!stop_.load()) {
        const std::uint32_t nudges = nudges_.load();
        std::uint64_t next = never, earliest = wake_late_sleepers(now_ns());
        do {
            next = earliest;
            next_.store(next);
            earliest = std::min(next, wake_late_sleepers(now_ns()));
        } while (earliest < next);
        if (next == never) // nobody sleeps: whoever is next will nudge
            futex_wait_forever(nudges_, nudges);
        else
            futex_wait_timed(nudges_, nudges, next - std::min(next, now_ns()));
    }
}

/// Returns the earliest deadline that is still to come. A sleeper that was woken and has not left his slot by
/// the next look, because he had announced himself and not slept yet, is woken again.
std::uint64_t SleepAlarm::wake_late_sleepers(std::uint64_t now) {
    std::uint64_t next = never;
    for (Slot& slot : slots_) {
        const std::uint64_t deadline = slot.deadline.load();
        if (deadline > now) {
            next = std::min(next, deadline);
            continue;
        }
        // The sleeper may leave meanwhile, and his word's memory with him: the call is then made for nothing.
        if (auto* const word = slot.word.load(); word != nullptr) futex_wake(*word, INT_MAX);
        next = std::min(next, now + again_ns);
    }
    return next;
}

} // namespace tandem::shm
