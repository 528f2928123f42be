// SPDX-License-Identifier: Apache-2.0
#include "host/process/bounded_call.hpp"

#include "host/process/exit/exit_timer.hpp"
#include "host/process/start_thread.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace tandem::process {
namespace {

std::atomic<int> running_calls{0};

constexpr std::chrono::seconds first_report{2};
constexpr std::chrono::seconds longest_start{1};

/// Counts one call as finished when `work` returns or throws.
struct FinishedOnExit {
    ~FinishedOnExit() { --running_calls; }
};

/// How far the thread of a series has come.
struct Progress {
    std::mutex mutex;
    std::size_t current; // the call that runs
    std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
    bool is_abandoned = false; // the thread ends after the current call
};

void run_calls(const BoundedCall::Series& series, Progress& progress) {
    std::unique_lock lock(progress.mutex);
    for (; progress.current < series.count && !progress.is_abandoned; ++progress.current) {
        const std::size_t i = progress.current;
        progress.began = std::chrono::steady_clock::now();
        lock.unlock();
        series.work(i);
        lock.lock();
    }
}

// Waits for the end of the thread. Returns the call that takes too long, if any, which is then the last one of the thread.
std::optional<std::size_t> wait_for(const std::future<void>& end, const BoundedCall::Series& series,
                                    Progress& progress) {
    std::size_t watched = series.count;
    std::chrono::nanoseconds timeout{0}, report{0}, shortest = series.timeout(0);
    for (std::size_t i = 1; i < series.count; ++i) shortest = std::min(shortest, series.timeout(i));
    for (;;) {
        std::unique_lock lock(progress.mutex);
        const std::size_t current = progress.current;
        if (current == series.count) return std::nullopt;
        if (std::exchange(watched, current) != current) {
            timeout = series.timeout(current);
            report = series.on_slow ? first_report : timeout;
        }
        const auto began = progress.began;
        const auto took = std::chrono::steady_clock::now() - began;
        progress.is_abandoned = took >= timeout;
        if (progress.is_abandoned) return current;
        lock.unlock();
        if (took >= report && report < timeout) {
            series.on_slow(current, std::chrono::duration_cast<std::chrono::seconds>(report));
            report *= 2;
        }
        // Looks again before the limit of a call that begins meanwhile.
        const auto next_look = began + std::min(std::min(report, timeout), took + shortest);
        if (end.wait_until(next_look) == std::future_status::ready) return std::nullopt;
    }
}

// Runs the calls in the calling thread. `error`: no other can be started.
void run_without_thread(const BoundedCall::Series& series, std::size_t first, const NotStarted& error) {
    for (std::size_t i = first; i < series.count; ++i) {
        std::optional<ExitTimer> limit;
        if (series.without_thread == BoundedCall::WithoutThread::exit)
            limit.emplace(
                series.timeout(i),
                std::string("error: a component's code does not return while the host ends, and the "
                            "host cannot continue without it: ") +
                    error.what(),
                1);
        series.work(i);
    }
}

} // namespace

void BoundedCall::run_series(const Series& series) {
    for (std::size_t first = 0; first < series.count;) {
        const auto progress = std::make_shared<Progress>();
        progress->current = first;
        std::promise<void> begun;
        const std::future<void> begin = begun.get_future();
        ++running_calls;
        const auto task = std::make_shared<std::packaged_task<void()>>(
            [series, progress, begun = std::move(begun)]() mutable {
                const FinishedOnExit counted;
                begun.set_value();
                run_calls(series, *progress);
            });
        std::future<void> end = task->get_future();
        std::thread thread;
        try {
            thread = start_thread([task] { (*task)(); });
        } catch (const NotStarted& error) { // the host still ends cleanly
            const FinishedOnExit counted;
            return run_without_thread(series, first, error);
        }
        if (begin.wait_for(longest_start) != std::future_status::ready) { // it gets no processor
            const std::lock_guard lock(progress->mutex);
            progress->began = std::chrono::steady_clock::now();
        }
        const auto slow = wait_for(end, series, *progress);
        if (!slow) {
            thread.join();
            return end.get(); // rethrows an exception of the call
        }
        thread.detach();
        if (!series.on_timeout(*slow)) return;
        first = *slow + 1;
    }
}

bool BoundedCall::returns_within(std::chrono::nanoseconds timeout, std::function<void()> work,
                                 const std::function<void(std::chrono::seconds)>& on_slow,
                                 WithoutThread without_thread) {
    bool returns = true;
    Series series{1,
                  [work = std::move(work)](std::size_t) { work(); },
                  [timeout](std::size_t) { return timeout; },
                  [&](std::size_t) { return returns = false; },
                  {},
                  without_thread};
    if (on_slow) series.on_slow = [&](std::size_t, std::chrono::seconds time) { on_slow(time); };
    run_series(series);
    return returns;
}

bool BoundedCall::any_running() { return running_calls != 0; }

} // namespace tandem::process
