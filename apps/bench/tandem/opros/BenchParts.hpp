// SPDX-License-Identifier: Apache-2.0
// What the bench asks of its OPRoS component, which does it through its ports.
#pragma once

#include "apps/bench/harness/tick_record.hpp"

#include <vector>

class BenchParts {
  public:
    virtual ~BenchParts() {}
    virtual void push(double value) = 0;
    virtual void push(const std::vector<double>& values) = 0;
    virtual double call(double value) = 0;
    virtual void send_event(double value) = 0;
    /// [any-thread] The value of the last event that has come.
    virtual double heard() const = 0;
    /// Takes the next double that has come, -1 when there is none.
    virtual double pop() = 0;
    /// [while it does not run]
    virtual const tandem::bench::TickRecord& ticks() const = 0;
};
