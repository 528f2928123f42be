// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"

#include <DataPortListener.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>

namespace tandem::engine {

/// Wakes the executor of an aperiodic component when an input has arrived: a value, an event, or a cycle of a
/// component it depends on. Any number of arrivals between two waits count as one. A word to sleep on (futex(2)): a
/// condition variable takes a system call more after each sleep, to leave its mutex, before the component runs. Or, where a
/// source has lent it, a waiter: then who sends through that source wakes the executor, which costs no second thread.
class InputSignal : public DataPortListener {
  public:
    /// [any-thread] Sets the signal. Called for every pushed value: costs one atomic exchange while it is set.
    void arrived() override;
    /// [any-thread] The first one that is offered is used, until it is withdrawn.
    bool offerWaiter(ArrivalWaiter* waiter) override;
    void withdrawWaiter(ArrivalWaiter* waiter) override;
    /// [executor] Waits for the signal and clears it.
    void wait();
    /// [executor] The same: true. False when it was not set within `timeout`. Without the waiter.
    bool wait_for(std::chrono::nanoseconds timeout);

  private:
    /// asleep, in_waiter: the executor sleeps on the word or in the waiter, or is about to.
    enum State : std::uint32_t { clear, set, asleep, in_waiter };
    class WaiterUse;

    bool take(State otherwise);
    void sleep(const struct timespec* timeout);
    void wake_waiter();

    std::atomic<std::uint32_t> state_{clear};
    rt::ShortMutex waiter_mutex_; ///< the members below
    std::condition_variable_any waiter_left_;
    ArrivalWaiter* waiter_ = nullptr;
    ArrivalWaiter* used_waiter_ = nullptr; ///< the one in which the executor is
};

} // namespace tandem::engine
