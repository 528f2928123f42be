// SPDX-License-Identifier: Apache-2.0
// The threads that deliver events and non-blocking calls.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace tandem::engine {

/// Each receiver has a lane: what goes down one lane is done in order and never two at a time.
class WorkerPool {
  public:
    using Job = std::function<void()>;

    /// With no workers, jobs are done at once by whoever submits them: lock-step is deterministic that way.
    WorkerPool(std::size_t workers, std::size_t jobs_per_worker);
    ~WorkerPool();

    /// [any-thread] False when the lane's worker has its hands full, or after stop(): the job is dropped.
    bool submit(std::size_t lane, Job job);
    /// Finishes the jobs under way, drops the others and ends the threads.
    void stop();

  private:
    struct Worker {
        std::mutex mutex;
        std::condition_variable wake;
        std::deque<Job> jobs;
        bool stopping = false;
        std::thread thread;
    };
    static void run(Worker& worker);

    const std::size_t jobs_per_worker_;
    std::vector<std::unique_ptr<Worker>> workers_;
};

} // namespace tandem::engine
