// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/bounded.hpp"

#include <atomic>
#include <future>
#include <thread>

namespace tandem::engine {
namespace {

std::atomic<int> under_way{0};

struct Done {
    ~Done() { --under_way; }
};

} // namespace

bool finishes_within(std::chrono::nanoseconds grace, std::function<void()> work) {
    ++under_way;
    std::packaged_task<void()> task([work = std::move(work)] {
        const Done counted;
        work();
    });
    std::future<void> end = task.get_future();
    std::thread thread(std::move(task));
    if (end.wait_for(grace) == std::future_status::timeout) {
        thread.detach();
        return false;
    }
    thread.join();
    end.get();
    return true;
}

bool work_goes_on() { return under_way != 0; }

} // namespace tandem::engine
