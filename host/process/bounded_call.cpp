// SPDX-License-Identifier: Apache-2.0
#include "host/process/bounded_call.hpp"

#include <atomic>
#include <future>
#include <thread>

namespace tandem::process {
namespace {

std::atomic<int> running_calls{0};

/// Counts one call as finished when `work` returns or throws.
struct FinishedOnExit {
    ~FinishedOnExit() { --running_calls; }
};

} // namespace

bool BoundedCall::returns_within(std::chrono::nanoseconds timeout, std::function<void()> work) {
    ++running_calls;
    std::packaged_task<void()> task([work = std::move(work)] {
        const FinishedOnExit counted;
        work();
    });
    std::future<void> end = task.get_future();
    std::thread thread(std::move(task));
    if (end.wait_for(timeout) == std::future_status::timeout) {
        thread.detach();
        return false;
    }
    thread.join();
    end.get(); // rethrows what `work` has thrown
    return true;
}

bool BoundedCall::any_running() { return running_calls != 0; }

} // namespace tandem::process
