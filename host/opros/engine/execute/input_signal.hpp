// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"

#include <DataPortListener.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>

namespace tandem::engine {

/// Wakes the executor of an aperiodic component when an input has arrived: a value, an event, or a cycle of a component
/// that it depends on. Any number of arrivals between two waits count as one. The executor sleeps on a word (futex(2)):
/// a condition variable would need one more system call after each sleep, to release its mutex, before the component
/// runs. If a source has lent a waiter, the executor sleeps in the waiter. The sender at that source then wakes the
/// executor, and no second thread is needed.
class InputSignal : public DataPortListener {
  public:
    /// [any-thread] Sets the signal. Called for every pushed value: costs one atomic exchange while it is set.
    void arrived() override;
    /// [any-thread] Offers a waiter. The first one that is offered is used until it is withdrawn.
    bool offerWaiter(ArrivalWaiter* waiter) override;
    void withdrawWaiter(ArrivalWaiter* waiter) override;
    /// [executor] Waits for the signal and clears it.
    void wait();
    /// [executor] Waits for the signal and clears it. Returns false if it was not set within `timeout`. Does not use
    /// the waiter.
    bool wait_for(std::chrono::nanoseconds timeout);

  private:
    /// asleep, in_waiter: the executor sleeps on the word or in the waiter, or is about to.
    enum State : std::uint32_t { clear, set, asleep, in_waiter };
    class WaiterUse;

    bool take(State otherwise);
    void sleep(const struct timespec* timeout);
    void wake_waiter();

    std::atomic<std::uint32_t> state_{clear};
    rt::ShortMutex waiter_mutex_; ///< guards the members below
    std::condition_variable_any waiter_left_;
    ArrivalWaiter* waiter_ = nullptr;
    ArrivalWaiter* used_waiter_ = nullptr; ///< the waiter that the executor is in
};

} // namespace tandem::engine
