// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rtm/RTObject.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace tandem::interceptor {

/// Activates, deactivates and resets one RTC, in the first execution context that it owns. Each function waits
/// for the callback of the RTC, for `timeout` or control::activation_timeout, whichever is longer, or likewise
/// deactivation_timeout, and returns an empty string or an error of one line. [any-thread]
class RtcDriver {
  public:
    /// Says of an RTC that it "went to ERROR" or "has exited".
    using Report = std::function<void(const char* what)>;

    /// `report` is called in the thread in which that happens; it must not wait. Throws std::runtime_error if the RTC
    /// owns no execution context.
    RtcDriver(RTC::RTObject_impl& rtc, std::chrono::milliseconds timeout, const Report& report);
    ~RtcDriver();

    std::string activate();
    std::string deactivate();
    std::string reset();
    bool is_active() const { return state() == RTC::ACTIVE_STATE; }

  private:
    class CallbackListener;
    using Operation = RTC::ReturnCode_t (RTC::_objref_ExecutionContext::*)(RTC::LightweightRTObject_ptr);
    // Both return as the functions above do.
    struct Transition {
        RTC::LifeCycleState from, to;
        Operation operation;
        const char* verb;     ///< participle, for messages
        const char* callback; ///< of the RTC
        std::chrono::milliseconds timeout;
    };
    std::string transition_and_wait(const Transition& transition);
    std::string wait_for_end(const Transition& transition) const;
    RTC::LifeCycleState state() const;

    RTC::RTObject_impl& rtc_;
    const std::string name_;
    RTC::RTObject_var reference_;
    RTC::ExecutionContext_var context_;
    const std::chrono::milliseconds timeout_;
    std::mutex mutex_; ///< one transition at a time: a new peer's activation waits for the old one's end
    std::unique_ptr<CallbackListener> error_listener_, reset_listener_, exit_listener_;
    std::atomic<bool> reset_ended_{false}; ///< onReset has returned, whatever
    std::atomic<bool> exited_{false};
};

} // namespace tandem::interceptor
