// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace tandem::engine {

/// Runs tasks for one component, in the order of their submission and one at a time: the events and
/// non-blocking calls that others send to it. Each component has its own queue and thread, so that a slow
/// receiver delays nobody else.
class TaskQueue {
  public:
    using Task = std::function<void()>;
    /// in_caller runs each task within submit(): in lock-step the order of all that happens is then fixed.
    enum class Mode { own_thread, in_caller };

    /// `capacity`: how many tasks may wait, with own_thread.
    TaskQueue(std::size_t capacity, Mode mode);
    /// interrupt() and join().
    ~TaskQueue();
    TaskQueue(const TaskQueue&) = delete;
    TaskQueue& operator=(const TaskQueue&) = delete;

    /// [main-thread] Creates the thread, unless it is there or none is wanted. Without senders there is none.
    void start();
    /// [any-thread] Never blocks on a task, but with in_caller runs it. False, and the task is dropped, when
    /// the queue is full or interrupted. Tasks must not throw.
    bool submit(Task task);
    /// [any-thread] Drops the tasks that wait and refuses further ones; the task that is running is not ended.
    void interrupt();
    /// [main-thread] After interrupt(): waits for the running task and the end of the thread.
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
