// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/drive/rtc_driver.hpp"

#include "host/log/log.hpp"

#include <functional>
#include <utility>

namespace tandem::interceptor {

class RtcDriver::CallbackListener final : public RTC::PostComponentActionListener {
  public:
    using OnReturn = std::function<void(RTC::ReturnCode_t result)>;
    explicit CallbackListener(OnReturn on_return) : on_return_(std::move(on_return)) {}
    void operator()(RTC::UniqueId, RTC::ReturnCode_t result) override { on_return_(result); }

  private:
    OnReturn on_return_;
};

namespace {
// onAborting() is the callback of the transition to ERROR; the listener is called after it.
constexpr auto entering_error = RTC::PostComponentActionListenerType::POST_ON_ABORTING;
constexpr auto after_exit = RTC::PostComponentActionListenerType::POST_ON_FINALIZE;
constexpr auto after_activation = RTC::PostComponentActionListenerType::POST_ON_ACTIVATED;
constexpr auto after_deactivation = RTC::PostComponentActionListenerType::POST_ON_DEACTIVATED;
constexpr auto after_reset = RTC::PostComponentActionListenerType::POST_ON_RESET;
} // namespace

RtcDriver::RtcDriver(RTC::RTObject_impl& rtc, std::chrono::milliseconds timeout, Events events)
    : rtc_(rtc), name_(rtc.getInstanceName()), events_(std::move(events)),
      error_listener_(
          std::make_unique<CallbackListener>([this](RTC::ReturnCode_t) { events_.failed("went to ERROR"); })),
      reset_listener_(
          std::make_unique<CallbackListener>([this](RTC::ReturnCode_t) { transitions_->end_reset(); })),
      exit_listener_(std::make_unique<CallbackListener>([this](RTC::ReturnCode_t) {
          exited_ = true;
          events_.failed("has exited");
      })),
      activated_listener_(std::make_unique<CallbackListener>([this](RTC::ReturnCode_t result) {
          if (result == RTC::RTC_OK) on_activated();
      })),
      deactivated_listener_(
          std::make_unique<CallbackListener>([this](RTC::ReturnCode_t) { on_deactivated(); })) {
    const RTC::ExecutionContextList_var contexts = rtc.get_owned_contexts();
    const RTC::ExecutionContext_var context = own_context(name_, contexts.in());
    const RTC::RTObject_var reference = rtc.getObjRef();
    transitions_ = std::make_unique<RtcTransitions>(name_, reference.in(), context.in(), timeout,
                                                    std::chrono::milliseconds(1));
    rtc_.addPostComponentActionListener(entering_error, error_listener_.get(), false);
    rtc_.addPostComponentActionListener(after_reset, reset_listener_.get(), false);
    rtc_.addPostComponentActionListener(after_exit, exit_listener_.get(), false);
    rtc_.addPostComponentActionListener(after_activation, activated_listener_.get(), false);
    rtc_.addPostComponentActionListener(after_deactivation, deactivated_listener_.get(), false);
}

RtcDriver::~RtcDriver() {
    // The RTC may have been deleted before this object, by its own exit() or by a tool: then `rtc_` dangles.
    if (RTC::Manager::instance().getComponent(name_.c_str()) != &rtc_) return;
    rtc_.removePostComponentActionListener(entering_error, error_listener_.get());
    rtc_.removePostComponentActionListener(after_reset, reset_listener_.get());
    rtc_.removePostComponentActionListener(after_exit, exit_listener_.get());
    rtc_.removePostComponentActionListener(after_activation, activated_listener_.get());
    rtc_.removePostComponentActionListener(after_deactivation, deactivated_listener_.get());
}

std::string RtcDriver::activate() {
    if (exited_ && !is_active()) return name_ + " has exited; start the RTM host again to have it back";
    {
        const std::lock_guard lock(late_mutex_);
        wanted_ = late_;
        if (late_) {
            log::warn("{} is still deactivating; it is activated when its onDeactivated has returned", name_);
            return "";
        }
    }
    return transitions_->activate();
}

std::string RtcDriver::deactivate() {
    std::uint64_t ended_before = 0;
    {
        const std::lock_guard lock(late_mutex_);
        wanted_ = false;
        deactivating_ = true;
        ended_before = deactivations_ended_;
    }
    std::string error = transitions_->deactivate();
    const bool active = is_active();
    const std::lock_guard lock(late_mutex_);
    deactivating_ = false;
    late_ = !error.empty() && active && deactivations_ended_ == ended_before;
    return error;
}

/// Called in the thread of the execution context, before the transition ends.
void RtcDriver::on_activated() {
    events_.activated();
    if (!thread_) return;
    thread_->post([this] {
        if (transitions_->wait_for_change(RTC::INACTIVE_STATE) == RTC::ACTIVE_STATE) events_.active();
    });
}

/// Like on_activated(). The transition may be one to ERROR.
void RtcDriver::on_deactivated() {
    const std::lock_guard lock(late_mutex_);
    ++deactivations_ended_;
    if (!thread_) return;
    if (late_)
        thread_->post([this] { end_late_deactivation(); });
    else if (!deactivating_)
        thread_->post([this] {
            if (transitions_->wait_for_change(RTC::ACTIVE_STATE) == RTC::INACTIVE_STATE)
                events_.deactivated_by_other();
        });
}

void RtcDriver::end_late_deactivation() {
    const std::string error = transitions_->deactivate(); // waits until onDeactivated has returned
    bool wanted = false;
    {
        const std::lock_guard lock(late_mutex_);
        if (!late_) return; // a later deactivation has already handled it
        late_ = false;
        wanted = std::exchange(wanted_, false);
    }
    if (!error.empty()) log::error("{}", error);
    if (!wanted) return;
    const std::string failure = transitions_->activate();
    if (!failure.empty()) return events_.failed("cannot be activated again: " + failure);
    log::info("{} is active again: its onDeactivated has returned", name_);
}

} // namespace tandem::interceptor
