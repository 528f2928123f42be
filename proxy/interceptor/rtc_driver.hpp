// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rtm/RTObject.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace tandem::interceptor {

/// Drives the life cycle of the RTC behind the interceptor, in its own (first) execution context.
/// The functions wait for the transition, never longer than `bound`; the result is empty or one line.
class RtcDriver {
  public:
    /// `failed` is called, in the context's thread, when the RTC goes to ERROR.
    RtcDriver(RTC::RTObject_impl& rtc, std::chrono::milliseconds bound, std::function<void()> failed);
    ~RtcDriver();

    std::string activate();
    std::string deactivate();
    std::string reset();

  private:
    class FailureListener;
    using Ask = RTC::ReturnCode_t (RTC::_objref_ExecutionContext::*)(RTC::LightweightRTObject_ptr);
    std::string transition(RTC::LifeCycleState from, RTC::LifeCycleState to, Ask ask, const char* verb);
    std::string reach(RTC::LifeCycleState wanted, const char* verb) const;
    RTC::LifeCycleState state() const;

    RTC::RTObject_impl& rtc_;
    const std::string name_;
    RTC::RTObject_var reference_;
    RTC::ExecutionContext_var context_;
    const std::chrono::milliseconds bound_;
    std::mutex mutex_; ///< one transition at a time: a peer that comes waits for the end of one that went
    std::unique_ptr<FailureListener> listener_;
};

} // namespace tandem::interceptor
