// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/manager/bounded_call.hpp"
#include <future>
#include <thread>

namespace RTC {

bool returns_within(std::chrono::nanoseconds bound, std::function<void()> call) {
    std::packaged_task<void()> task(std::move(call));
    auto done = task.get_future();
    std::thread thread(std::move(task));
    if (done.wait_for(bound) != std::future_status::ready) {
        thread.detach();
        return false;
    }
    thread.join();
    done.get();
    return true;
}

} // namespace RTC
