// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/crash/callback_scope.hpp"
#include <map>
#include <rtm/RTObject.h>

namespace RTC {

/// Returns whether the callback belongs to a life-cycle transition (`onInitialize`, `onActivated` ... `onShutdown`) and
/// so is not called in every cycle.
bool is_transition_callback(const std::string& name);

/// While an object exists, callbacks of a transition may run, and the main loop regularly looks for slow ones.
/// [any-thread]
class TransitionScope {
  public:
    TransitionScope();
    ~TransitionScope();
    TransitionScope(const TransitionScope&) = delete;
    TransitionScope& operator=(const TransitionScope&) = delete;
};

/// Logs callbacks of transitions that take 2 s, 4 s, 8 s, ... and the end of each logged callback. A slow onActivated,
/// for example of a camera, is not a failure, but the user waits for it. [main-thread]
class SlowTransitions {
  public:
    /// Checks the current callbacks of the components and returns the lines for the log. The components must not be
    /// deleted meanwhile.
    std::vector<std::string> check(const std::vector<RTObject_impl*>& components);
    /// Makes the end of the component's current callback be logged, however short the callback is.
    void expect_end(const RTObject_impl& component);
    /// Returns whether check() must be called again soon: a transition is in progress, or the end of a slow one is not
    /// logged yet.
    bool needs_check() const;

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::chrono::seconds first_report{2};
    struct Slow {
        tandem::crash::RunningCallback callback;
        std::chrono::seconds next_report = first_report;
        Clock::time_point end{}; // zero while it runs
    };
    std::string report(RTObject_impl& component, Slow& slow);

    std::map<const RTObject_impl*, Slow> slow_;
};

} // namespace RTC
