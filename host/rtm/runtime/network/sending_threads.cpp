// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/network/sending_threads.hpp"
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

namespace RTC {
namespace {

struct Running {
    std::mutex mutex;
    std::condition_variable ended;
    unsigned count = 0; // guarded by the mutex
};

// Never destroyed: a thread may end while static objects are being destroyed.
Running& running() {
    static auto& all = *new Running;
    return all;
}

} // namespace

bool start_sending_thread(std::function<void()> work) {
    std::lock_guard<std::mutex> lock(running().mutex); // the thread is counted before it can end
    try {
        std::thread([work = std::move(work)]() mutable {
            work();
            work =
                nullptr; // destroys the objects of `work`, such as CORBA references, before the thread is uncounted
            std::lock_guard<std::mutex> lock(running().mutex);
            --running().count;
            running().ended.notify_all();
        }).detach();
    } catch (const std::system_error&) {
        return false;
    }
    ++running().count;
    return true;
}

bool sending_threads_end_within(std::chrono::nanoseconds timeout) {
    std::unique_lock<std::mutex> lock(running().mutex);
    return running().ended.wait_for(lock, timeout, [] { return running().count == 0; });
}

} // namespace RTC
