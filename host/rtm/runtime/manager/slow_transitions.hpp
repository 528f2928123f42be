// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/crash/callback_scope.hpp"
#include <map>
#include <rtm/RTObject.h>

namespace RTC {

/// `onInitialize`, `onActivated` ... `onShutdown`: called once for a transition of the life cycle, and not in every cycle.
bool is_transition_callback(const std::string& name);

/// While one lives, callbacks of a transition may run, and the main loop looks for slow ones every so often. [any-thread]
class TransitionScope {
  public:
    TransitionScope();
    ~TransitionScope();
    TransitionScope(const TransitionScope&) = delete;
    TransitionScope& operator=(const TransitionScope&) = delete;
};

/// Logs callbacks of transitions that take 2 s, 4 s, 8 s, ... and the end of each that it has logged. A slow
/// onActivated, of a camera for instance, is no failure, but somebody waits for it. [main-thread]
class SlowTransitions {
  public:
    /// Looks at the callbacks that the components are in, and returns the lines for the log; the components must not be
    /// deleted meanwhile.
    std::vector<std::string> check(const std::vector<RTObject_impl*>& components);
    /// The end of the callback that the component is in will be logged, however short it is.
    void expect_end(const RTObject_impl& component);
    /// Whether check() has to be called again soon: a transition is under way, or the end of a slow one not logged.
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
