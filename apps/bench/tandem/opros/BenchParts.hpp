// SPDX-License-Identifier: Apache-2.0
// The OPRoS component of the engine's cases, as the bench drives it: each function uses one of its ports. Two
// instances, From and To, are connected; the calls go to From, the values arrive in To.
#pragma once

#include "apps/bench/harness/tick_record.hpp"

#include <vector>

class BenchParts {
  public:
    virtual ~BenchParts() {}
    /// Through an output data port each.
    virtual void push(double value) = 0;
    virtual void push(const std::vector<double>& values) = 0;
    /// Calls the peer's service, which returns twice the value.
    virtual double call(double value) = 0;
    /// Through an event port; the engine calls the peer's onEvent() in another thread.
    virtual void send_event(double value) = 0;
    /// [any-thread] The value of the last event that onEvent() was called with.
    virtual double last_event() const = 0;
    /// Takes the oldest value out of the input port; -1 when there is none.
    virtual double pop_value() = 0;
    /// [while the component does not run] What its onExecute() has recorded.
    virtual const tandem::bench::TickRecord& tick_record() const = 0;
};
