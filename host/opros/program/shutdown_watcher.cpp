// SPDX-License-Identifier: Apache-2.0
#include "host/opros/program/shutdown_watcher.hpp"
#include "host/process/exit_process.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <semaphore>
#include <spdlog/spdlog.h>
#include <thread>
#include <unistd.h>

namespace tandem::engine {
using namespace std::chrono_literals;

/// Shared by the main thread, which sets it up and waits, and the watching thread.
struct ShutdownWatcher::State {
    using Clock = std::chrono::steady_clock;
    std::binary_semaphore signalled{0}, setup_finished{0};

    std::mutex mutex; // for all below
    std::string current_step = "the reading of profiles and loading of libraries";
    Clock::time_point step_start = Clock::now();
    std::chrono::seconds next_warning{10}; // after step_start
    bool setup_over = false;

    /// At growing intervals, after 10 s, 20 s, 40 s, ..., so that a slow device does not fill the log.
    void log_slow_step() {
        const std::lock_guard<std::mutex> lock(mutex);
        if (setup_over || Clock::now() - step_start < next_warning) return;
        spdlog::warn("{} has taken {} s so far; Ctrl-C ends the host", current_step, next_warning.count());
        next_warning *= 2;
    }
    bool setup_in_progress() {
        const std::lock_guard<std::mutex> lock(mutex);
        return !setup_over;
    }
    std::string step_name() {
        const std::lock_guard<std::mutex> lock(mutex);
        return current_step;
    }
};

ShutdownWatcher::ShutdownWatcher(const sigset_t& signals, std::chrono::nanoseconds grace)
    : state_(std::make_shared<State>()) {
    std::thread([state = state_, signals, grace] { watch(*state, signals, grace); }).detach();
}

void ShutdownWatcher::watch(State& state, const sigset_t& signals, std::chrono::nanoseconds grace) {
    int number = 0;
    const timespec second{1, 0};
    // During the set-up the wait ends each second, to look for a slow step; afterwards it costs nothing.
    while (number <= 0 && state.setup_in_progress()) {
        number = sigtimedwait(&signals, nullptr, &second);
        if (number <= 0) state.log_slow_step();
    }
    if (number <= 0) sigwait(&signals, &number);
    spdlog::info("stopping on {}", strsignal(number));
    state.signalled.release();
    if (state.setup_finished.try_acquire_for(grace)) exit_on_second_signal(signals);
    spdlog::error("{} does not return within {} s; the host exits", state.step_name(),
                  std::chrono::duration<double>(grace).count());
    process::exit_process(1);
}

void ShutdownWatcher::exit_on_second_signal(const sigset_t& signals) {
    // The first second: signals are taken and dropped.
    const auto end = State::Clock::now() + 1s;
    for (auto left = 1000ms; left > 0ms;
         left = std::chrono::duration_cast<std::chrono::milliseconds>(end - State::Clock::now())) {
        const timespec timeout{0, std::min<long>(left.count(), 999) * 1'000'000};
        sigtimedwait(&signals, nullptr, &timeout);
    }
    // One thread that does not block a signal is enough for the kernel to deliver it: its default action then
    // ends the process, so that the exit status names the signal.
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    for (;;) pause();
}

void ShutdownWatcher::begin_step(const std::string& component, const char* callback) {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->current_step = std::string(callback) + " of component " + component;
    state_->step_start = State::Clock::now();
    state_->next_warning = 10s;
}

void ShutdownWatcher::wait_for_signal() {
    {
        const std::lock_guard<std::mutex> lock(state_->mutex);
        state_->setup_over = true;
    }
    state_->setup_finished.release();
    state_->signalled.acquire();
}

} // namespace tandem::engine
