// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/registry.hpp"

#include <string>

namespace tandem::bench {

/// Adds cases that need only one process: components of one host, and hand-written code for comparison.
class InProcessCases {
  public:
    InProcessCases(Registry& registry, Group group, std::string subject)
        : registry_(registry), prototype_{.group = group,
                                          .subject = std::move(subject),
                                          .placement = Placement::alone} {}

    /// Wake::none: no thread waits, because the caller's thread does all the work.
    void add(const char* operation, std::size_t bytes, Wake wake, void (*run)(Session&),
             const char* detail = "", Unit unit = Unit::ns) {
        registry_.add(make(operation, bytes, wake, run, detail, unit));
    }
    /// Adds a case whose thread sleeps until the event arrives, with both power profiles.
    void add_event(void (*run)(Session&)) {
        Case event = make("event", sizeof(double), Wake::blocking, run);
        registry_.add(event);
        event.power_profile = PowerProfile::low_latency_idle;
        registry_.add(event);
    }
    /// 100,000 ticks of 1 ms take longer than the timeout of other cases.
    void add_tick_drift(void (*run)(Session&)) {
        Case drift = make("tick-drift", sizeof(double), Wake::blocking, run);
        drift.extra_seconds = 110;
        registry_.add(drift);
    }

  private:
    Case make(const char* operation, std::size_t bytes, Wake wake, void (*run)(Session&),
              const char* detail = "", Unit unit = Unit::ns) const {
        Case entry = prototype_;
        entry.operation = operation;
        entry.bytes = bytes;
        entry.wake = wake;
        entry.run = run;
        entry.detail = detail;
        entry.unit = unit;
        return entry;
    }

    Registry& registry_;
    Case prototype_;
};

} // namespace tandem::bench
