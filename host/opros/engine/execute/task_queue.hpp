// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace tandem::engine {

/// Runs tasks for one component, one at a time and in the order of their submission: the events and non-blocking calls
/// that other components send to it. Each component has a separate queue and thread, so that a slow receiver does not
/// delay other components.
class TaskQueue {
  public:
    using Task = std::function<void()>;
    /// in_caller runs each task within submit(), which fixes the order of all actions in lock-step.
    enum class Mode { own_thread, in_caller };

    /// `capacity` limits the waiting tasks, with own_thread.
    TaskQueue(std::size_t capacity, Mode mode);
    /// Calls interrupt() and join().
    ~TaskQueue();
    TaskQueue(const TaskQueue&) = delete;
    TaskQueue& operator=(const TaskQueue&) = delete;

    /// [main-thread] Creates the thread, unless it exists or none is wanted. Without senders there is no thread.
    void start();
    /// [any-thread] Never blocks on a task, except that in_caller runs it. Returns false, and drops the task, if the
    /// queue is full or interrupted. Tasks must not throw.
    bool submit(Task task);
    /// [any-thread] Drops the waiting tasks and refuses new ones. Does not end the running task.
    void interrupt();
    /// [main-thread] Waits, after interrupt(), for the running task and the end of the thread.
    void join();

  private:
    void run();

    const std::size_t capacity_;
    const Mode mode_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Task> tasks_;   // under mutex_
    bool interrupted_ = false; // under mutex_
    std::thread thread_;
};

} // namespace tandem::engine
