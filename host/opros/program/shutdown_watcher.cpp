// SPDX-License-Identifier: Apache-2.0
#include "host/opros/program/shutdown_watcher.hpp"
#include "host/log/log.hpp"
#include "host/process/exit/exit_process.hpp"
#include "host/process/start_thread.hpp"
#include "host/process/step_timer.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <semaphore>
#include <thread>
#include <unistd.h>

namespace tandem::engine {
using namespace std::chrono_literals;

/// Shared by the main thread, which sets up the application and waits, and by the watching thread.
struct ShutdownWatcher::State {
    using Clock = std::chrono::steady_clock;
    std::binary_semaphore signalled{0}, setup_finished{0};

    process::StepTimer timer{"the reading of profiles and loading of libraries"};
    std::atomic<bool> setup_over{false}, ending{false};
};

ShutdownWatcher::ShutdownWatcher(const sigset_t& signals, std::chrono::nanoseconds grace)
    : state_(std::make_shared<State>()) {
    process::start_thread([state = state_, signals, grace] { watch(*state, signals, grace); }).detach();
}

void ShutdownWatcher::watch(State& state, const sigset_t& signals, std::chrono::nanoseconds grace) {
    int number = 0;
    const timespec interval{0, 100'000'000};
    // During set-up, wakes ten times a second to look for a slow step. Afterwards waiting costs nothing.
    while (number <= 0 && !state.setup_over) {
        number = sigtimedwait(&signals, nullptr, &interval);
        if (const auto slow = state.timer.slow_step(); number <= 0 && !slow.empty() && !state.setup_over)
            log::warn("{}; Ctrl-C ends the host", slow);
    }
    if (number <= 0) sigwait(&signals, &number);
    log::info("stopping on {}", strsignal(number));
    state.ending = true;
    state.signalled.release();
    if (state.setup_finished.try_acquire_for(grace)) exit_on_second_signal(signals);
    log::error("{} does not return within {} s; the host exits", state.timer.step(),
               std::chrono::duration<double>(grace).count());
    process::exit_process(1);
}

void ShutdownWatcher::exit_on_second_signal(const sigset_t& signals) {
    // Consumes and ignores signals during the first second.
    const auto end = State::Clock::now() + 1s;
    for (auto left = 1000ms; left > 0ms;
         left = std::chrono::duration_cast<std::chrono::milliseconds>(end - State::Clock::now())) {
        const timespec timeout{0, std::min<long>(left.count(), 999) * 1'000'000};
        sigtimedwait(&signals, nullptr, &timeout);
    }
    // The kernel needs only one thread that does not block a signal. The signal's default action then ends the
    // process, so that the exit status names the signal.
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    for (;;) pause();
}

void ShutdownWatcher::begin_step(const std::string& component, const char* callback) {
    state_->timer.begin(std::string(callback) + " of component " + component);
}

std::function<bool()> ShutdownWatcher::signalled() const {
    return [state = state_] { return state->ending.load(); };
}

void ShutdownWatcher::wait_for_signal() {
    state_->setup_over = true;
    state_->setup_finished.release();
    state_->signalled.acquire();
}

} // namespace tandem::engine
