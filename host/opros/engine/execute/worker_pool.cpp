// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/execute/worker_pool.hpp"

namespace tandem::engine {

WorkerPool::WorkerPool(std::size_t jobs_per_worker, bool with_threads)
    : jobs_per_worker_(jobs_per_worker), with_threads_(with_threads) {}

Worker& WorkerPool::of(const void* receiver) {
    auto& worker = workers_[receiver];
    if (!worker) worker = std::make_unique<Worker>(jobs_per_worker_, with_threads_);
    return *worker;
}

void WorkerPool::stop() {
    for (auto& [receiver, worker] : workers_) worker->interrupt();
    for (auto& [receiver, worker] : workers_) worker->join();
}

} // namespace tandem::engine
