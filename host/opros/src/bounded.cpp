// SPDX-License-Identifier: Apache-2.0
#include "host/opros/src/bounded.hpp"

#include <future>
#include <thread>

namespace tandem::engine {

bool finishes_within(std::chrono::nanoseconds grace, std::function<void()> work) {
    std::packaged_task<void()> task(std::move(work));
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

} // namespace tandem::engine
