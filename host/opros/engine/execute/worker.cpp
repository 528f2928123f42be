// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/worker.hpp"

#include "host/rt/thread.hpp"

namespace tandem::engine {

Worker::Worker(std::size_t max_jobs, bool with_thread) : max_jobs_(max_jobs), with_thread_(with_thread) {
    if (with_thread_) thread_ = std::thread([this] { run(); });
}

Worker::~Worker() {
    interrupt();
    join();
}

void Worker::run() {
    rt::configure_this_thread({"worker", 0, -1});
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
        wake_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
        if (stopping_) return;
        Job job = std::move(jobs_.front());
        jobs_.pop_front();
        lock.unlock();
        job();
        lock.lock();
    }
}

bool Worker::submit(Job job) {
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (stopping_ || (with_thread_ && jobs_.size() >= max_jobs_)) return false;
        if (with_thread_) jobs_.push_back(std::move(job));
    }
    if (with_thread_)
        wake_.notify_one();
    else
        job();
    return true;
}

void Worker::interrupt() {
    std::deque<Job> dropped; // destroyed without the lock: what they hold is a component's
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        stopping_ = true;
        dropped.swap(jobs_);
    }
    wake_.notify_one();
}

void Worker::join() {
    if (thread_.joinable()) thread_.join();
}

} // namespace tandem::engine
