// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/task_queue.hpp"

#include "host/log/log.hpp"
#include "host/process/start_thread.hpp"
#include "proxy/link/session/link_thread.hpp"

namespace tandem::link {

void TaskQueue::start() {
    const std::lock_guard lock(mutex_);
    if (!stopping_ && !thread_.joinable()) thread_ = process::start_thread([this] { run(); });
}

void TaskQueue::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
}

void TaskQueue::post(std::function<void()> task) {
    const std::lock_guard lock(mutex_);
    tasks_.push_back({std::move(task), 0});
    changed_.notify_all();
}

bool TaskQueue::post_in_turn(std::chrono::nanoseconds timeout, std::size_t bytes,
                             std::function<void()> task) {
    std::unique_lock lock(mutex_);
    if ((!has_room(bytes) || !waiting_.empty()) && !wait_for_turn(lock, timeout, bytes)) return false;
    tasks_.push_back({std::move(task), bytes});
    bytes_ += bytes;
    changed_.notify_all();
    return true;
}

bool TaskQueue::has_room(std::size_t bytes) const {
    return tasks_.empty() ||
           (tasks_.size() < max_tasks_ && bytes_ <= max_bytes_ && bytes <= max_bytes_ - bytes_);
}

bool TaskQueue::wait_for_turn(std::unique_lock<std::mutex>& lock, std::chrono::nanoseconds timeout,
                              std::size_t bytes) {
    const auto place = waiting_.insert(waiting_.end(), 0);
    const bool has_come = changed_.wait_for(
        lock, timeout, [&] { return stopping_ || (place == waiting_.begin() && has_room(bytes)); });
    waiting_.erase(place);
    changed_.notify_all(); // it is the next one's turn
    return has_come && !stopping_;
}

void TaskQueue::run() {
    begin_link_thread("tandem-tasks");
    std::unique_lock lock(mutex_);
    while (!stopping_) {
        changed_.wait(lock, [this] { return !tasks_.empty() || stopping_; });
        if (stopping_) break;
        const auto task = std::move(tasks_.front().run);
        bytes_ -= tasks_.front().bytes;
        tasks_.pop_front();
        if (!waiting_.empty()) changed_.notify_all();
        lock.unlock(); // a task may take seconds, and may post another one
        try {
            task();
        } catch (const std::exception& error) { // the remaining tasks must run nevertheless
            log::error("link '{}': {}", owner_, error.what());
        }
        lock.lock();
    }
}

} // namespace tandem::link
