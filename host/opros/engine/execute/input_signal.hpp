// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <DataPortListener.h>

#include <atomic>
#include <chrono>
#include <cstdint>

namespace tandem::engine {

/// Wakes the executor of an aperiodic component when an input has arrived: a value, an event, or a cycle of a
/// component it depends on. Any number of arrivals between two waits count as one. A word to sleep on (futex(2)): a
/// condition variable takes a system call more after each sleep, to leave its mutex, before the component runs.
class InputSignal : public DataPortListener {
  public:
    /// [any-thread] Sets the signal. Called for every pushed value: costs one atomic exchange while it is set.
    void arrived() override;
    /// [executor] Waits for the signal and clears it.
    void wait();
    /// [executor] The same: true. False when it was not set within `timeout`.
    bool wait_for(std::chrono::nanoseconds timeout);

  private:
    enum State : std::uint32_t { clear, set, asleep }; // asleep: the executor is, or is about to be

    bool take();
    void sleep(const struct timespec* timeout);

    std::atomic<std::uint32_t> state_{clear};
};

} // namespace tandem::engine
