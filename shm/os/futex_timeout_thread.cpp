// SPDX-License-Identifier: Apache-2.0
#include "shm/os/futex_timeout_thread.hpp"

#include "shm/os/clock.hpp"
#include "shm/os/futex.hpp"

#include <climits>
#include <csignal>
#include <functional>
#include <sys/syscall.h>
#include <unistd.h>

namespace tandem::shm {

namespace {

constexpr int wake_signal = SIGURG;
thread_local pid_t this_thread = 0; // set once the thread has unblocked the signal

pid_t unblock_signal() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, wake_signal);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    return static_cast<pid_t>(syscall(SYS_gettid));
}

/// Returns false if the program itself uses the signal.
bool handle_signal() {
    struct sigaction before {};
    if (sigaction(wake_signal, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) return false;
    struct sigaction action {};
    action.sa_handler = [](int) {}; // without SA_RESTART, so the signal ends the futex call
    return sigaction(wake_signal, &action, nullptr) == 0;
}

} // namespace

FutexTimeoutThread& FutexTimeoutThread::of_process() {
    static FutexTimeoutThread instance;
    return instance;
}

FutexTimeoutThread::FutexTimeoutThread() {
    pthread_atfork(nullptr, nullptr, [] { of_process().reset_after_fork(); });
}

FutexTimeoutThread::~FutexTimeoutThread() {
    const bool running = state_.exchange(State::unavailable) == State::running;
    stop_.store(true);
    wake_thread();
    if (running) pthread_join(thread_, nullptr);
}

/// In the child only the thread that forked exists: neither the timeout thread nor any sleeper.
void FutexTimeoutThread::reset_after_fork() {
    pthread_mutex_init(&starting_, nullptr); // its owner may not exist here to unlock it
    for (Slot& slot : slots_) {
        slot.deadline.store(never);
        slot.thread.store(0);
    }
    this_thread = 0;
    next_check_.store(never);
    state_.store(State::not_started);
}

bool FutexTimeoutThread::start() {
    pthread_mutex_lock(&starting_);
    signal_handled_ = signal_handled_ || handle_signal();
    if (state_.load() == State::not_started && !signal_handled_) state_.store(State::unavailable);
    if (state_.load() == State::not_started) {
        process_ = getpid();
        sigset_t all, before;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all,
                        &before); // the program's own threads handle the program's signals
        const auto run = [](void* self) -> void* {
            static_cast<FutexTimeoutThread*>(self)->run();
            return nullptr;
        };
        const bool created = pthread_create(&thread_, nullptr, run, this) == 0;
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
        if (created) pthread_setname_np(thread_, "tandem-timeout");
        state_.store(created ? State::running : State::unavailable);
    }
    pthread_mutex_unlock(&starting_);
    return state_.load() == State::running;
}

// Sleeper and thread each store one word and then load the other's, all seq_cst (as in wait/sleep_until.hpp):
//
//     sleeper: slot.deadline = d | next_check_ > d ?        thread: next_check_ = n | scan the slots: d < n ?
//
// At least one of the two sees the other: either the thread sleeps until d, or the sleeper wakes it.
bool FutexTimeoutThread::sleep(std::atomic<std::uint32_t>& word, std::uint32_t expected,
                               std::uint64_t deadline) {
    const State state = state_.load(std::memory_order_acquire);
    if (state == State::unavailable || (state == State::not_started && !start())) return false;
    if (this_thread == 0) this_thread = unblock_signal();
    const auto first =
        static_cast<std::size_t>(this_thread); // usually the slot of last time, which is in this core's cache
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        Slot& slot = slots_[(first + i) % slots_.size()];
        pid_t nobody = 0;
        if (!slot.thread.compare_exchange_strong(nobody, this_thread, std::memory_order_acquire)) continue;
        slot.word.store(&word, std::memory_order_relaxed);
        slot.deadline.store(deadline);
        if (next_check_.load() > deadline) wake_thread();
        futex_wait_forever(word, expected);
        slot.deadline.store(never, std::memory_order_relaxed);
        slot.thread.store(0, std::memory_order_release);
        return true;
    }
    return false;
}

// The thread repeats the wake-up of an overdue sleep until the slot is free, so it does not matter whether the sleeper
// has entered its system call yet. If another sleeper takes the slot meanwhile, that sleeper returns early, which is allowed.
void FutexTimeoutThread::end_sleeps(std::span<const std::byte> memory) {
    for (Slot& slot : slots_) {
        std::uint64_t deadline = slot.deadline.load();
        if (deadline == never) continue;
        const auto* const word =
            reinterpret_cast<const std::byte*>(slot.word.load(std::memory_order_relaxed));
        if (std::less<>()(word, memory.data()) || !std::less<>()(word, memory.data() + memory.size()))
            continue;
        slot.deadline.compare_exchange_strong(deadline, 0); // fails if the sleep is over
    }
    if (state_.load() == State::running) wake_thread();
}

void FutexTimeoutThread::wake_thread() {
    wake_count_.fetch_add(1);
    futex_wake(wake_count_, 1);
}

void FutexTimeoutThread::run() {
    while (!stop_.load()) {
        const std::uint32_t wake_count = wake_count_.load();
        std::uint64_t next = never, earliest = end_overdue_sleeps(now_ns());
        do { // scans again after each store of next_check_ until no earlier deadline appears
            next = earliest;
            next_check_.store(next);
            earliest = std::min(next, end_overdue_sleeps(now_ns()));
        } while (earliest < next);
        if (next == never) // no sleeper is left: the next one wakes this thread
            futex_wait_forever(wake_count_, wake_count);
        else
            futex_wait_timed(wake_count_, wake_count, next - std::min(next, now_ns()));
    }
}

/// Returns the earliest deadline that has not passed. A sleeper between taking its slot and its system call has missed the
/// wake-up; its slot remains and is visited again after retry_ns.
std::uint64_t FutexTimeoutThread::end_overdue_sleeps(std::uint64_t now) {
    std::uint64_t next = never;
    for (Slot& slot : slots_) {
        const std::uint64_t deadline = slot.deadline.load();
        if (deadline > now) {
            next = std::min(next, deadline);
            continue;
        }
        // The sleeper may return meanwhile, and its word's memory may be freed. Then the wake-up reaches nobody or a sleeper
        // that checks its condition again, and the signal reaches no thread or a thread in which it does nothing.
        if (auto* const word = slot.word.load(std::memory_order_relaxed)) futex_wake(*word, INT_MAX);
        if (const pid_t thread = slot.thread.load(); thread != 0)
            syscall(SYS_tgkill, process_, thread, wake_signal);
        next = std::min(next, now + retry_ns);
    }
    return next;
}

} // namespace tandem::shm
