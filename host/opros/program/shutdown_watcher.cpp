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

struct ShutdownWatcher::State {
    using Clock = std::chrono::steady_clock;
    std::binary_semaphore signalled{0}, ready{0};
    std::mutex mutex;
    std::string busy = "the reading of profiles and loading of libraries";
    Clock::time_point since = Clock::now();
    std::chrono::seconds slow_step_threshold{10};
    bool over = false;

    /// Ever more rarely: after 10 s, 20 s, 40 s, ...
    void log_slow_step() {
        const std::lock_guard<std::mutex> lock(mutex);
        if (over || Clock::now() - since < slow_step_threshold) return;
        spdlog::warn("{} has taken {} s so far; Ctrl-C ends the host", busy, slow_step_threshold.count());
        slow_step_threshold *= 2;
    }
    bool setup_in_progress() {
        const std::lock_guard<std::mutex> lock(mutex);
        return !over;
    }
    std::string what() {
        const std::lock_guard<std::mutex> lock(mutex);
        return busy;
    }
};

ShutdownWatcher::ShutdownWatcher(const sigset_t& signals, std::chrono::nanoseconds grace)
    : state_(std::make_shared<State>()) {
    std::thread([state = state_, signals, grace] { watch(*state, signals, grace); }).detach();
}

void ShutdownWatcher::watch(State& state, const sigset_t& signals, std::chrono::nanoseconds grace) {
    int number = 0;
    const timespec second{1, 0};
    while (number <= 0 && state.setup_in_progress()) {
        number = sigtimedwait(&signals, nullptr, &second);
        if (number <= 0) state.log_slow_step();
    }
    if (number <= 0) sigwait(&signals, &number);
    spdlog::info("stopping on {}", strsignal(number));
    state.signalled.release();
    if (state.ready.try_acquire_for(grace)) exit_on_second_signal(signals);
    spdlog::error("{} does not come back within {} s; the host ends", state.what(),
                  std::chrono::duration<double>(grace).count());
    process::exit_process(1);
}

void ShutdownWatcher::exit_on_second_signal(const sigset_t& signals) {
    const auto until = State::Clock::now() + 1s;
    for (auto left = 1000ms; left > 0ms;
         left = std::chrono::duration_cast<std::chrono::milliseconds>(until - State::Clock::now())) {
        const timespec rest{0, std::min<long>(left.count(), 999) * 1'000'000};
        sigtimedwait(&signals, nullptr, &rest);
    }
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr); // in this thread, and for the process thereby
    for (;;) pause();
}

void ShutdownWatcher::begin_step(const std::string& component, const char* step) {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->busy = std::string(step) + " of component " + component;
    state_->since = State::Clock::now();
    state_->slow_step_threshold = 10s;
}

void ShutdownWatcher::wait_for_signal() {
    {
        const std::lock_guard<std::mutex> lock(state_->mutex);
        state_->over = true;
    }
    state_->ready.release();
    state_->signalled.acquire();
}

} // namespace tandem::engine
