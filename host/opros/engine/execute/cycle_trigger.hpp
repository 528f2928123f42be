// SPDX-License-Identifier: Apache-2.0
// When an executor gives its components a cycle.
#pragma once

#include "host/opros/engine/execute/component_host.hpp"
#include "host/rt/periodic_tick.hpp"

#include <memory>
#include <string>

namespace tandem::engine {

class CycleTrigger {
  public:
    virtual ~CycleTrigger() = default;
    /// [executor] Waits for the time of the next cycle; false: there is none any more.
    virtual bool wait() = 0;
    /// [any-thread] Makes wait() return false, soon.
    virtual void interrupt() = 0;
    /// [any-thread] What has been counted, in words.
    virtual std::string stats() const = 0;
};

/// The pace that the component's profile asks for: at its period, when an input arrives, or without a pause.
/// A periodic one polls for `spin` before its ticks, and calls `warm_up` (rt::TickOptions) before that.
std::unique_ptr<CycleTrigger> make_cycle_trigger(ComponentHost& component, std::chrono::nanoseconds spin,
                                                 std::function<void()> warm_up);

} // namespace tandem::engine
