// SPDX-License-Identifier: Apache-2.0
#include "host/process/bounded_call.hpp"

#include "host/process/exit/exit_timer.hpp"
#include "host/process/start_thread.hpp"

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace tandem::process {
namespace {

std::atomic<int> running_calls{0};

constexpr std::chrono::seconds first_report{2};
constexpr std::chrono::seconds longest_start{1};

/// Counts one call as finished when `work` returns or throws.
struct FinishedOnExit {
    ~FinishedOnExit() { --running_calls; }
};

// Returns false if `end` is not ready within `timeout`.
bool wait_for(const std::future<void>& end, std::chrono::nanoseconds timeout,
              const std::function<void(std::chrono::seconds)>& on_slow) {
    const auto start = std::chrono::steady_clock::now();
    for (auto report = first_report; on_slow && report < timeout; report *= 2) {
        if (end.wait_until(start + report) == std::future_status::ready) return true;
        on_slow(report);
    }
    return end.wait_until(start + timeout) == std::future_status::ready;
}

} // namespace

bool BoundedCall::returns_within(std::chrono::nanoseconds timeout, std::function<void()> work,
                                 const std::function<void(std::chrono::seconds)>& on_slow,
                                 WithoutThread without_thread) {
    ++running_calls;
    std::promise<void> begun;
    const std::future<void> begin = begun.get_future();
    auto task = std::make_shared<std::packaged_task<void()>>(
        [work = std::move(work), begun = std::move(begun)]() mutable {
            const FinishedOnExit counted;
            begun.set_value();
            work();
        });
    std::future<void> end = task->get_future();
    std::thread thread;
    try {
        thread = start_thread([task] { (*task)(); });
    } catch (const NotStarted& error) { // the host still ends in order
        std::optional<ExitTimer> limit;
        if (without_thread == WithoutThread::exit)
            limit.emplace(
                timeout,
                std::string("error: a component's code does not return while the host ends, and the "
                            "host cannot go on without it: ") +
                    error.what(),
                1);
        (*task)();
        end.get();
        return true;
    }
    begin.wait_for(longest_start);
    if (!wait_for(end, timeout, on_slow)) {
        thread.detach();
        return false;
    }
    thread.join();
    end.get(); // rethrows an exception of `work`
    return true;
}

bool BoundedCall::any_running() { return running_calls != 0; }

} // namespace tandem::process
