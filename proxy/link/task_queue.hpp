// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace tandem::link {

/// Executes tasks one after the other in a thread of its own, in the order in which they were posted. A link
/// uses it for everything that may wait for the peer, because the supervisor thread must not.
class TaskQueue {
  public:
    /// `owner` is the link's name, for log lines.
    explicit TaskQueue(std::string owner) : owner_(std::move(owner)) {}
    ~TaskQueue() { stop(); }
    TaskQueue(const TaskQueue&) = delete;
    TaskQueue& operator=(const TaskQueue&) = delete;

    void start();
    /// Waits for the task that is running; those behind it are never executed. [not in the task thread]
    void stop();

    /// Appends a task. An exception that it throws is logged. [any-thread]
    void post(std::function<void()> task);

  private:
    void run();

    const std::string owner_;
    std::mutex mutex_; ///< tasks_, stopping_
    std::condition_variable changed_;
    std::deque<std::function<void()>> tasks_;
    bool stopping_ = false;
    std::thread thread_;
};

} // namespace tandem::link
