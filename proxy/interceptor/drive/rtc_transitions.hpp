// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rtm/RTC.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace tandem::interceptor {

/// The transitions of one RTC, of this process or another, in one execution context. Each waits for the callback of the
/// RTC, for `timeout` or control::activation_timeout, whichever is longer, or likewise deactivation_timeout, and returns
/// an empty string or an error of one line. [any-thread]
class RtcTransitions {
  public:
    /// `pause`: between two looks at the state. Calls by the references end as their time limits say.
    RtcTransitions(std::string name, RTC::RTObject_ptr rtc, RTC::ExecutionContext_ptr context,
                   std::chrono::milliseconds timeout, std::chrono::milliseconds pause);

    std::string activate();
    std::string deactivate();
    std::string reset();
    /// CREATED if it does not answer; no transition begins there.
    RTC::LifeCycleState state() const;
    /// onReset has returned, whatever: an RTC that is in ERROR after this stays there. Who is not told so waits.
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

    const std::string name_;
    const RTC::RTObject_var reference_;
    const RTC::ExecutionContext_var context_;
    const std::chrono::milliseconds timeout_, pause_;
    std::mutex mutex_; ///< one transition at a time: a new peer's activation waits for the old one's end
    std::atomic<bool> reset_ended_{false};
};

/// The first execution context that the RTC owns; those that it was attached to later are driven by those who attached
/// it. Throws std::runtime_error if it has none, and CORBA::Exception.
RTC::ExecutionContext_ptr own_context(const std::string& name, const RTC::ExecutionContextList& owned);

} // namespace tandem::interceptor
