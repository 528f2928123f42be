// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace tandem::engine {

/// Delivers events and non-blocking calls to one receiver: in order and never two at a time.
class Worker {
  public:
    using Job = std::function<void()>;

    /// Without a thread, jobs are done at once by whoever submits them: lock-step is deterministic that way.
    Worker(std::size_t max_jobs, bool with_thread);
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// [any-thread] False when so many jobs are waiting already, or after interrupt(): the job is dropped.
    bool submit(Job job);
    /// Drops the jobs that wait; the thread ends after the one under way. join() waits for that.
    void interrupt();
    void join();

  private:
    void run();

    const std::size_t max_jobs_;
    const bool with_thread_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Job> jobs_;
    bool stopping_ = false;
    std::thread thread_;
};

} // namespace tandem::engine
