// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/crash/callback_scope.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/rt/periodic_tick.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace tandem::engine {

/// Decides when an executor runs the next cycle of its components. There is one implementation for each ExecutionType
/// that is executed at all.
class CycleTrigger {
  public:
    virtual ~CycleTrigger() = default;
    /// [executor] Waits until the next cycle is due and returns true. Returns false after interrupt().
    virtual bool wait() = 0;
    /// [any-thread] Makes the current wait and all later waits return false at once.
    virtual void interrupt() = 0;
    /// [any-thread] Returns the trigger's kind and counters in words.
    virtual std::string stats() const = 0;
    /// Returns the ticks of a periodic trigger; NULL: another one.
    virtual rt::PeriodicTick* tick() { return nullptr; }
    /// Returns where the executor publishes the callback that it is in; NULL: nowhere.
    virtual crash::CallbackText* callback_text() const { return nullptr; }
};

/// Creates the trigger that the profile of `component` asks for. A periodic trigger polls the clock for the last
/// `tick_spin` before each tick (none: the default of rt::TickOptions) and calls `rehearse` before that (see
/// rt::TickOptions). `component` must outlive the trigger.
std::unique_ptr<CycleTrigger> make_cycle_trigger(ComponentHost& component,
                                                 std::optional<std::chrono::nanoseconds> tick_spin,
                                                 std::function<void()> rehearse);

} // namespace tandem::engine
