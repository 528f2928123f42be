// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/worker.hpp"

#include <map>
#include <memory>

namespace tandem::engine {

/// A worker for each component that receives events or non-blocking calls: a slow one delays nobody else.
class WorkerPool {
  public:
    WorkerPool(std::size_t jobs_per_worker, bool with_threads);

    /// [main-thread] The receiver's own, made when it is asked for first; it lives as long as the pool.
    Worker& of(const void* receiver);
    /// Finishes the jobs under way, drops the others and ends the threads.
    void stop();

  private:
    const std::size_t jobs_per_worker_;
    const bool with_threads_;
    std::map<const void*, std::unique_ptr<Worker>> workers_;
};

} // namespace tandem::engine
