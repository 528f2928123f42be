// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/task_queue.hpp"

#include "host/process/start_thread.hpp"
#include "host/rt/thread.hpp"

namespace tandem::engine {

TaskQueue::TaskQueue(std::size_t capacity, Mode mode) : capacity_(capacity), mode_(mode) {}

TaskQueue::~TaskQueue() {
    interrupt();
    join();
}

void TaskQueue::start() {
    if (mode_ == Mode::own_thread && !thread_.joinable()) thread_ = process::start_thread([this] { run(); });
}

void TaskQueue::run() {
    rt::configure_this_thread({"worker", 0, -1});
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return interrupted_ || !tasks_.empty(); });
        if (interrupted_) return;
        Task task = std::move(tasks_.front());
        tasks_.pop_front();
        lock.unlock(); // a task may submit another one to the same queue
        task();
        task = nullptr; // destroys the task without the lock, because that may take a while
        lock.lock();
    }
}

bool TaskQueue::submit(Task task) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (interrupted_) return false;
    if (mode_ == Mode::in_caller) {
        lock.unlock();
        task();
        return true;
    }
    if (tasks_.size() >= capacity_) return false;
    tasks_.push_back(std::move(task));
    lock.unlock();
    wake_.notify_one();
    return true;
}

void TaskQueue::interrupt() {
    std::deque<Task> dropped; // destroyed without the lock: tasks hold values of a component, with its code
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        interrupted_ = true;
        dropped.swap(tasks_);
    }
    wake_.notify_one();
}

void TaskQueue::join() {
    if (thread_.joinable()) thread_.join();
}

} // namespace tandem::engine
