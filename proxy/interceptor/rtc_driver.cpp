// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/rtc_driver.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <thread>

namespace tandem::interceptor {
namespace {

const char* name_of(RTC::LifeCycleState state) {
    switch (state) {
    case RTC::CREATED_STATE:
        return "CREATED";
    case RTC::INACTIVE_STATE:
        return "INACTIVE";
    case RTC::ACTIVE_STATE:
        return "ACTIVE";
    default:
        return "ERROR";
    }
}

} // namespace

class RtcDriver::FailureListener final : public RTC::PostComponentActionListener {
  public:
    explicit FailureListener(std::function<void()> failed) : failed_(std::move(failed)) {}
    void operator()(RTC::UniqueId, RTC::ReturnCode_t) override { failed_(); }

  private:
    std::function<void()> failed_;
};

namespace {
constexpr auto entering_error = RTC::PostComponentActionListenerType::POST_ON_ABORTING;
}

RtcDriver::RtcDriver(RTC::RTObject_impl& rtc, std::chrono::milliseconds bound, std::function<void()> failed)
    : rtc_(rtc), reference_(rtc.getObjRef()), bound_(bound),
      listener_(std::make_unique<FailureListener>(std::move(failed))) {
    RTC::ExecutionContextList_var contexts = rtc.get_owned_contexts();
    if (contexts->length() == 0)
        throw std::runtime_error(
            fmt::format("RTC '{}' has no execution context of its own", rtc.getInstanceName()));
    context_ = RTC::ExecutionContext::_duplicate(contexts[0]);
    rtc_.addPostComponentActionListener(entering_error, listener_.get(), false);
}

RtcDriver::~RtcDriver() { rtc_.removePostComponentActionListener(entering_error, listener_.get()); }

RTC::LifeCycleState RtcDriver::state() const { return context_->get_component_state(reference_); }

std::string RtcDriver::activate() {
    if (state() == RTC::ACTIVE_STATE) return "";
    if (state() == RTC::ERROR_STATE) return "it is in ERROR; reset it first";
    // An RTC that is still being created has a context that does not run yet and refuses: ask again.
    const auto deadline = std::chrono::steady_clock::now() + bound_;
    auto asked = context_->activate_component(reference_);
    while (asked != RTC::RTC_OK && state() == RTC::INACTIVE_STATE &&
           std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        asked = context_->activate_component(reference_);
    }
    return reach(RTC::ACTIVE_STATE, asked, "activated");
}

std::string RtcDriver::deactivate() {
    if (state() != RTC::ACTIVE_STATE) return "";
    return reach(RTC::INACTIVE_STATE, context_->deactivate_component(reference_), "deactivated");
}

std::string RtcDriver::reset() {
    if (state() != RTC::ERROR_STATE) return "";
    return reach(RTC::INACTIVE_STATE, context_->reset_component(reference_), "reset");
}

/// The context may carry out a transition in its next cycle only.
std::string RtcDriver::reach(RTC::LifeCycleState wanted, RTC::ReturnCode_t asked, const char* verb) const {
    const auto deadline = std::chrono::steady_clock::now() + bound_;
    auto now = state();
    while (asked == RTC::RTC_OK && now != wanted && now != RTC::ERROR_STATE &&
           std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        now = state();
    }
    return now == wanted
               ? ""
               : fmt::format("it is {} and was not {} within {} ms", name_of(now), verb, bound_.count());
}

} // namespace tandem::interceptor
