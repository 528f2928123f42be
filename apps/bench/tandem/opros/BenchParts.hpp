// SPDX-License-Identifier: Apache-2.0
// The OPRoS component of the engine's cases, as the bench drives it: each function uses one of its ports. Two
// instances, From and To, are connected; the bench calls From, and the values arrive in To.
#pragma once

#include "apps/bench/harness/tick_record.hpp"

#include <vector>

class BenchParts {
  public:
    virtual ~BenchParts() {}
    /// Send through an output data port each.
    virtual void push(double value) = 0;
    virtual void push(const std::vector<double>& values) = 0;
    /// Calls the peer's service, which returns twice the value.
    virtual double call(double value) = 0;
    /// Sends through an event port; the engine calls the peer's onEvent() in another thread.
    virtual void send_event(double value) = 0;
    /// [any-thread] Returns the value of the last event that onEvent() received.
    virtual double last_event() const = 0;
    /// Takes the oldest value out of the input port; returns -1 if there is none.
    virtual double pop_value() = 0;
    /// [while the component does not run] Returns what its onExecute() has recorded.
    virtual const tandem::bench::TickRecord& tick_record() const = 0;
};
