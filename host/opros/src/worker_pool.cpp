// SPDX-License-Identifier: Apache-2.0
#include "host/opros/src/worker_pool.hpp"

#include "host/rt/thread.hpp"

namespace tandem::engine {

WorkerPool::WorkerPool(std::size_t workers, std::size_t jobs_per_worker) : jobs_per_worker_(jobs_per_worker) {
    for (std::size_t i = 0; i < workers; ++i) workers_.push_back(std::make_unique<Worker>());
    for (auto& worker : workers_) worker->thread = std::thread([&worker = *worker] { run(worker); });
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::run(Worker& worker) {
    rt::set_up_this_thread({"worker", 0, -1});
    std::unique_lock<std::mutex> lock(worker.mutex);
    for (;;) {
        worker.wake.wait(lock, [&] { return worker.stopping || !worker.jobs.empty(); });
        if (worker.stopping) return;
        Job job = std::move(worker.jobs.front());
        worker.jobs.pop_front();
        lock.unlock();
        job();
        lock.lock();
    }
}

bool WorkerPool::submit(std::size_t lane, Job job) {
    if (workers_.empty()) {
        job();
        return true;
    }
    Worker& worker = *workers_[lane % workers_.size()];
    {
        const std::lock_guard<std::mutex> lock(worker.mutex);
        if (worker.stopping || worker.jobs.size() >= jobs_per_worker_) return false;
        worker.jobs.push_back(std::move(job));
    }
    worker.wake.notify_one();
    return true;
}

void WorkerPool::stop() {
    for (auto& worker : workers_) {
        {
            const std::lock_guard<std::mutex> lock(worker->mutex);
            worker->stopping = true;
            worker->jobs.clear();
        }
        worker->wake.notify_one();
    }
    for (auto& worker : workers_)
        if (worker->thread.joinable()) worker->thread.join();
}

} // namespace tandem::engine
