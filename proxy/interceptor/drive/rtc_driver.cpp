// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/drive/rtc_driver.hpp"

#include <rtm/Manager.h>

#include <functional>

namespace tandem::interceptor {

class RtcDriver::CallbackListener final : public RTC::PostComponentActionListener {
  public:
    explicit CallbackListener(std::function<void()> on_return) : on_return_(std::move(on_return)) {}
    void operator()(RTC::UniqueId, RTC::ReturnCode_t) override { on_return_(); }

  private:
    std::function<void()> on_return_;
};

namespace {
// onAborting() is the callback of the transition to ERROR; the listener is called after it.
constexpr auto entering_error = RTC::PostComponentActionListenerType::POST_ON_ABORTING;
constexpr auto after_exit = RTC::PostComponentActionListenerType::POST_ON_FINALIZE;
constexpr auto after_reset = RTC::PostComponentActionListenerType::POST_ON_RESET;
} // namespace

RtcDriver::RtcDriver(RTC::RTObject_impl& rtc, std::chrono::milliseconds timeout, const Report& report)
    : rtc_(rtc), name_(rtc.getInstanceName()),
      error_listener_(std::make_unique<CallbackListener>([report] { report("went to ERROR"); })),
      reset_listener_(std::make_unique<CallbackListener>([this] { transitions_->end_reset(); })),
      exit_listener_(std::make_unique<CallbackListener>([this, report] {
          exited_ = true;
          report("has exited");
      })) {
    const RTC::ExecutionContextList_var contexts = rtc.get_owned_contexts();
    const RTC::ExecutionContext_var context = own_context(name_, contexts.in());
    const RTC::RTObject_var reference = rtc.getObjRef();
    transitions_ = std::make_unique<RtcTransitions>(name_, reference.in(), context.in(), timeout,
                                                    std::chrono::milliseconds(1));
    rtc_.addPostComponentActionListener(entering_error, error_listener_.get(), false);
    rtc_.addPostComponentActionListener(after_reset, reset_listener_.get(), false);
    rtc_.addPostComponentActionListener(after_exit, exit_listener_.get(), false);
}

RtcDriver::~RtcDriver() {
    // The RTC may have been deleted before this object, by its own exit() or by a tool: then `rtc_` dangles.
    if (RTC::Manager::instance().getComponent(name_.c_str()) != &rtc_) return;
    rtc_.removePostComponentActionListener(entering_error, error_listener_.get());
    rtc_.removePostComponentActionListener(after_reset, reset_listener_.get());
    rtc_.removePostComponentActionListener(after_exit, exit_listener_.get());
}

std::string RtcDriver::activate() {
    if (exited_ && !is_active()) return name_ + " has exited; start the RTM host again to have it back";
    return transitions_->activate();
}

} // namespace tandem::interceptor
