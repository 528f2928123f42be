// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

namespace tandem::link {

/// Executes tasks one at a time in its own thread, in the order in which they were posted. A link uses it for all
/// work that may wait for the peer, because the supervisor thread must not wait.
class TaskQueue {
  public:
    /// `owner` is the link's name, for log lines. At most `max_tasks` tasks of post_in_turn() wait, with `max_bytes` together.
    explicit TaskQueue(std::string owner, std::size_t max_tasks = SIZE_MAX, std::size_t max_bytes = SIZE_MAX)
        : owner_(std::move(owner)), max_tasks_(max_tasks), max_bytes_(max_bytes) {}
    ~TaskQueue() { stop(); }
    TaskQueue(const TaskQueue&) = delete;
    TaskQueue& operator=(const TaskQueue&) = delete;

    /// Starts the thread unless it is running.
    void start();
    /// Waits for the running task. The tasks after it never run. [not in the task thread]
    void stop();

    /// Appends a task. Logs exceptions of the task. [any-thread]
    void post(std::function<void()> task);
    /// Appends a task that holds `bytes` of memory when no other waits, or there is room for one more. Threads that wait for
    /// this get their turn in the order in which they came. Returns false after `timeout`, or if the queue is stopped
    /// meanwhile. [any-thread but the task thread]
    bool post_in_turn(std::chrono::nanoseconds timeout, std::size_t bytes, std::function<void()> task);

  private:
    struct Task {
        std::function<void()> run;
        std::size_t bytes;
    };
    void run();
    bool has_room(std::size_t bytes) const;
    bool wait_for_turn(std::unique_lock<std::mutex>& lock, std::chrono::nanoseconds timeout,
                       std::size_t bytes);

    const std::string owner_;
    const std::size_t max_tasks_, max_bytes_;
    std::mutex mutex_; ///< guards the members below
    std::condition_variable changed_;
    std::deque<Task> tasks_;
    std::size_t bytes_ = 0;  ///< of tasks_
    std::list<int> waiting_; ///< one element for each thread in post_in_turn()
    bool stopping_ = false;
    std::thread thread_;
};

} // namespace tandem::link
