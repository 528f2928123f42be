// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/drive/driven_rtc.hpp"
#include "proxy/interceptor/drive/rtc_transitions.hpp"

#include <rtm/RTObject.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace tandem::interceptor {

/// Drives one RTC of this process, in the first execution context that it owns. [any-thread]
class RtcDriver final : public DrivenRtc {
  public:
    /// Says of an RTC that it "went to ERROR" or "has exited".
    using Report = std::function<void(const char* what)>;

    /// `timeout`: see RtcTransitions. `report` is called in the thread in which that happens; it must not wait. Throws
    /// std::runtime_error if the RTC owns no execution context.
    RtcDriver(RTC::RTObject_impl& rtc, std::chrono::milliseconds timeout, const Report& report);
    ~RtcDriver() override;
    RtcDriver(const RtcDriver&) = delete;
    RtcDriver& operator=(const RtcDriver&) = delete;

    std::string activate() override;
    std::string deactivate() override { return transitions_->deactivate(); }
    std::string reset() override { return transitions_->reset(); }
    bool is_active() const override { return transitions_->state() == RTC::ACTIVE_STATE; }

  private:
    class CallbackListener;

    RTC::RTObject_impl& rtc_;
    const std::string name_;
    std::unique_ptr<RtcTransitions> transitions_;
    std::unique_ptr<CallbackListener> error_listener_, reset_listener_, exit_listener_;
    std::atomic<bool> exited_{false};
};

} // namespace tandem::interceptor
