// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <DataPortListener.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace tandem::engine {

/// Wakes the executor of an aperiodic component when an input has arrived: a value, an event, or a cycle of a
/// component it depends on. Any number of arrivals between two waits count as one.
class InputSignal : public DataPortListener {
  public:
    /// [any-thread] Sets the signal. Called for every pushed value: costs one atomic exchange while it is set.
    void arrived() override;
    /// [executor] Waits for the signal and clears it.
    void wait();
    /// [executor] The same: true. False when it was not set within `timeout`.
    bool wait_for(std::chrono::nanoseconds timeout);

  private:
    std::atomic<bool> pending_{false};
    std::mutex mutex_; // for the wait only; pending_ is changed without it
    std::condition_variable wake_;
};

} // namespace tandem::engine
