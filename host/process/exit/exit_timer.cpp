// SPDX-License-Identifier: Apache-2.0
#include "host/process/exit/exit_timer.hpp"

#include <algorithm>
#include <atomic>
#include <climits>
#include <csignal>
#include <deque>
#include <mutex>
#include <poll.h>
#include <string>
#include <unistd.h>
#include <utility>

namespace tandem::process {
namespace {

struct Action {
    Action(std::string text, int code) : line(std::move(text)), code(code) {}
    const std::string line;
    const int code;
    std::atomic<bool> is_armed{true};
};

/// Keeps all actions until the process ends: a pending signal refers to its action.
Action& keep_action(std::string line, int code) {
    static auto& mutex = *new std::mutex;
    static auto& all = *new std::deque<Action>;
    const std::lock_guard lock(mutex);
    return all.emplace_back(std::move(line), code);
}

/// Signal handler: calls only async-signal-safe functions.
void end_process(int, siginfo_t* info, void*) {
    if (info->si_code != SI_TIMER) return;
    const auto& action = *static_cast<const Action*>(info->si_value.sival_ptr);
    if (!action.is_armed) return;
    pollfd ready{STDERR_FILENO, POLLOUT, 0};
    // A ready pipe takes a line of this length without blocking.
    if (!action.line.empty() && poll(&ready, 1, 0) > 0) [[maybe_unused]]
        const auto written =
            write(STDERR_FILENO, action.line.data(), std::min<std::size_t>(action.line.size(), PIPE_BUF));
    _exit(action.code);
}

} // namespace

ExitTimer::ExitTimer(std::chrono::nanoseconds limit, const std::string& line, int code) {
    auto& action = keep_action(line.empty() ? "" : line + "\n", code);
    is_armed_ = &action.is_armed;
    struct sigaction handler {};
    handler.sa_sigaction = end_process;
    handler.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaction(SIGRTMAX, &handler, nullptr);
    sigset_t signal;
    sigemptyset(&signal);
    sigaddset(&signal, SIGRTMAX);
    pthread_sigmask(SIG_UNBLOCK, &signal, nullptr); // one thread that takes it is enough
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGRTMAX;
    event.sigev_value.sival_ptr = &action;
    has_timer_ = timer_create(CLOCK_MONOTONIC, &event, &timer_) == 0;
    const auto ns = std::max<std::chrono::nanoseconds::rep>(limit.count(), 1); // 0 would disarm it
    const itimerspec at{{0, 0}, {ns / 1'000'000'000, ns % 1'000'000'000}};
    if (has_timer_) timer_settime(timer_, 0, &at, nullptr);
}

ExitTimer::~ExitTimer() {
    *is_armed_ = false;
    if (has_timer_) timer_delete(timer_);
}

} // namespace tandem::process
