// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

#include "plugins/wheelchair/core/plant/parameters.hpp"

namespace tandem::wheelchair {

/// CLOCK_MONOTONIC in seconds: one clock for all processes of a machine, so stamps of different hosts
/// compare.
inline double monotonic_seconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The clock of a component's stamps: in simulation the number of its tick times 10 ms, else CLOCK_MONOTONIC.
class TickClock {
  public:
    explicit TickClock(bool simulated) : simulated_(simulated) {}
    bool simulated() const { return simulated_; }
    double at(int tick) const { return simulated_ ? tick * tick_seconds : monotonic_seconds(); }

  private:
    bool simulated_;
};

} // namespace tandem::wheelchair
