// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rtm/RTC.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace tandem::interceptor {

/// The state transitions of one RTC, of this or another process, in one execution context. Each waits for the RTC's
/// callback, for `timeout` or for control::activation_timeout (deactivation_timeout for deactivations), whichever is
/// longer. Returns an empty string or an error of one line. [any-thread]
class RtcTransitions {
  public:
    /// `pause`: the time between two checks of the state. Calls through the references end at their own time limits.
    RtcTransitions(std::string name, RTC::RTObject_ptr rtc, RTC::ExecutionContext_ptr context,
                   std::chrono::milliseconds timeout, std::chrono::milliseconds pause);

    std::string activate();
    std::string deactivate();
    std::string reset();
    /// Waits at most 1 s for the end of a transition from this state whose callback has returned. Returns the state then.
    RTC::LifeCycleState wait_for_change(RTC::LifeCycleState from) const;
    /// Returns CREATED if the RTC does not answer; no transition begins in this state.
    RTC::LifeCycleState state() const;
    /// Call it when onReset has returned. If the RTC is still in ERROR, it stays there, and reset() stops waiting; otherwise
    /// reset() would wait until its timeout.
    void end_reset() { reset_ended_ = true; }

  private:
    using Operation = RTC::ReturnCode_t (RTC::_objref_ExecutionContext::*)(RTC::LightweightRTObject_ptr);
    struct Transition {
        RTC::LifeCycleState from, to;
        Operation operation;
        const char* verb;     ///< participle, for messages
        const char* callback; ///< of the RTC
        std::chrono::milliseconds timeout;
    };
    std::string transition_and_wait(const Transition& transition);
    std::string wait_for_end(const Transition& transition) const;
    struct Callbacks {
        std::string failed, running; ///< empty: none, or unknown
    };
    Callbacks callbacks() const;

    const std::string name_;
    const RTC::RTObject_var reference_;
    const RTC::ExecutionContext_var context_;
    const std::chrono::milliseconds timeout_, pause_;
    std::mutex mutex_; ///< one transition at a time: that of a new peer waits for the earlier one
    std::atomic<bool> reset_ended_{false};
};

/// Returns the first execution context that the RTC owns; contexts that others attached later belong to those. Throws
/// std::runtime_error if it has none, and CORBA::Exception.
RTC::ExecutionContext_ptr own_context(const std::string& name, const RTC::ExecutionContextList& owned);

} // namespace tandem::interceptor
