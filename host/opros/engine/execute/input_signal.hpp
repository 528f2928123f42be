// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <DataPortListener.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace tandem::engine {

/// That something has come for a component: what an aperiodic executor waits for.
class InputSignal : public DataPortListener {
  public:
    /// [any-thread]
    void arrived() override;
    /// True as soon as something has come since the last call; false when the time is over.
    bool wait_for(std::chrono::nanoseconds timeout);

  private:
    std::atomic<bool> pending_{false};
    std::mutex mutex_;
    std::condition_variable wake_;
};

} // namespace tandem::engine
