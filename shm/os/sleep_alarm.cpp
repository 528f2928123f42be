// SPDX-License-Identifier: Apache-2.0
#include "shm/os/sleep_alarm.hpp"

#include <climits>
#include <csignal>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::shm {

namespace {

constexpr int alarm_signal = SIGURG;
thread_local pid_t this_thread = 0; // once it has let the signal through

pid_t let_signal_through() {
    sigset_t ours;
    sigemptyset(&ours);
    sigaddset(&ours, alarm_signal);
    pthread_sigmask(SIG_UNBLOCK, &ours, nullptr);
    return static_cast<pid_t>(syscall(SYS_gettid));
}

/// False: somebody else uses the signal.
bool handle_signal() {
    struct sigaction before {};
    if (sigaction(alarm_signal, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) return false;
    struct sigaction action {};
    action.sa_handler = [](int) {}; // and no SA_RESTART: the sleep ends
    return sigaction(alarm_signal, &action, nullptr) == 0;
}

} // namespace

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
        slot.thread.store(0);
    }
    this_thread = 0;
    next_.store(never);
    state_.store(State::unborn);
}

bool SleepAlarm::start() {
    pthread_mutex_lock(&starting_);
    const bool handled = signal_handled_ || (signal_handled_ = handle_signal());
    if (state_.load() == State::unborn && !handled) state_.store(State::refused);
    if (state_.load() == State::unborn) {
        process_ = getpid();
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
    const State state = state_.load(std::memory_order_acquire);
    if (state == State::refused || (state == State::unborn && !start())) return false;
    if (this_thread == 0) this_thread = let_signal_through();
    const auto first = static_cast<std::size_t>(this_thread); // its slot as a rule, in its core's cache
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        Slot& slot = slots_[(first + i) % slots_.size()];
        pid_t nobody = 0;
        if (!slot.thread.compare_exchange_strong(nobody, this_thread, std::memory_order_acquire)) continue;
        slot.word.store(&word, std::memory_order_relaxed);
        slot.deadline.store(deadline);
        if (next_.load() > deadline) nudge();
        futex_wait_forever(word, expected);
        slot.deadline.store(never, std::memory_order_relaxed);
        slot.thread.store(0, std::memory_order_release);
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
        std::uint64_t next = never, earliest = end_late_sleeps(now_ns());
        do {
            next = earliest;
            next_.store(next);
            earliest = std::min(next, end_late_sleeps(now_ns()));
        } while (earliest < next);
        if (next == never) // nobody sleeps: whoever is next will nudge
            futex_wait_forever(nudges_, nudges);
        else
            futex_wait_timed(nudges_, nudges, next - std::min(next, now_ns()));
    }
}

/// Returns the earliest deadline that is still to come. A sleeper who was between his slot and the system
/// call is met again by the next look.
std::uint64_t SleepAlarm::end_late_sleeps(std::uint64_t now) {
    std::uint64_t next = never;
    for (Slot& slot : slots_) {
        const std::uint64_t deadline = slot.deadline.load();
        if (deadline > now) {
            next = std::min(next, deadline);
            continue;
        }
        // He may leave meanwhile, and his word's memory with him. The wake is then for nothing or for
        // somebody who looks again, and the signal meets nobody, or somebody to whom it does nothing.
        if (auto* const word = slot.word.load(std::memory_order_relaxed)) futex_wake(*word, INT_MAX);
        if (const pid_t thread = slot.thread.load(); thread != 0)
            syscall(SYS_tgkill, process_, thread, alarm_signal);
        next = std::min(next, now + again_ns);
    }
    return next;
}

} // namespace tandem::shm
