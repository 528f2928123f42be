// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/rtc_driver.hpp"

#include <rtm/Manager.h>

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

class RtcDriver::ErrorListener final : public RTC::PostComponentActionListener {
  public:
    explicit ErrorListener(std::function<void()> on_error) : on_error_(std::move(on_error)) {}
    void operator()(RTC::UniqueId, RTC::ReturnCode_t) override { on_error_(); }

  private:
    std::function<void()> on_error_;
};

namespace {
// onAborting() is the callback of the transition to ERROR; the listener is called after it.
constexpr auto entering_error = RTC::PostComponentActionListenerType::POST_ON_ABORTING;
} // namespace

RtcDriver::RtcDriver(RTC::RTObject_impl& rtc, std::chrono::milliseconds timeout,
                     std::function<void()> on_error)
    : rtc_(rtc), name_(rtc.getInstanceName()), reference_(rtc.getObjRef()), timeout_(timeout),
      listener_(std::make_unique<ErrorListener>(std::move(on_error))) {
    RTC::ExecutionContextList_var contexts = rtc.get_owned_contexts();
    if (contexts->length() == 0)
        throw std::runtime_error(
            fmt::format("RTC '{}' has no execution context of its own", rtc.getInstanceName()));
    // Contexts that the RTC was attached to later are driven by those who attached it.
    context_ = RTC::ExecutionContext::_duplicate(contexts[0]);
    rtc_.addPostComponentActionListener(entering_error, listener_.get(), false);
}

RtcDriver::~RtcDriver() {
    // The RTC may have been deleted before this object, by its own exit() or by a tool: then `rtc_` dangles.
    if (RTC::Manager::instance().getComponent(name_.c_str()) == &rtc_)
        rtc_.removePostComponentActionListener(entering_error, listener_.get());
}

RTC::LifeCycleState RtcDriver::state() const {
    try {
        return context_->get_component_state(reference_);
    } catch (const CORBA::Exception&) {
        return RTC::CREATED_STATE; // it was deleted; no transition accepts this state
    }
}

std::string RtcDriver::activate() {
    const std::lock_guard lock(mutex_);
    if (state() == RTC::ACTIVE_STATE) return "";
    // Not reset here: whether an error may be ignored is the user's decision.
    if (state() == RTC::ERROR_STATE) return name_ + " is in ERROR; reset it first";
    return transition_and_wait(RTC::INACTIVE_STATE, RTC::ACTIVE_STATE,
                               &RTC::_objref_ExecutionContext::activate_component, "activated");
}

std::string RtcDriver::deactivate() {
    const std::lock_guard lock(mutex_);
    if (state() != RTC::ACTIVE_STATE) return "";
    return transition_and_wait(RTC::ACTIVE_STATE, RTC::INACTIVE_STATE,
                               &RTC::_objref_ExecutionContext::deactivate_component, "deactivated");
}

std::string RtcDriver::reset() {
    const std::lock_guard lock(mutex_);
    if (state() != RTC::ERROR_STATE) return "";
    return transition_and_wait(RTC::ERROR_STATE, RTC::INACTIVE_STATE,
                               &RTC::_objref_ExecutionContext::reset_component, "reset");
}

/// Asks the execution context for a transition and waits until it is done. Asks again while the context does
/// not accept it: a host that has just started may have created the RTC but not yet started its context.
std::string RtcDriver::transition_and_wait(RTC::LifeCycleState from, RTC::LifeCycleState to,
                                           Operation operation, const char* verb) {
    const auto deadline = std::chrono::steady_clock::now() + timeout_;
    try {
        auto result = RTC::PRECONDITION_NOT_MET;
        for (;;) {
            // Another client, a tool for instance, may have made the same transition meanwhile: that is fine.
            if (state() == from) result = (context_->*operation)(reference_);
            if (result == RTC::RTC_OK || state() == to) return wait_for_state(to, verb);
            if (result != RTC::PRECONDITION_NOT_MET || std::chrono::steady_clock::now() >= deadline) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return fmt::format("{} is {}, {} was expected, and it was not {}: its context answers {}", name_,
                           name_of(state()), name_of(from), verb, static_cast<int>(result));
    } catch (const CORBA::Exception& error) { // the RTC or its context has left
        return fmt::format("{} was not {}: {}", name_, verb, error._name());
    }
}

/// Waits, because a context carries out a transition in its next cycle only.
std::string RtcDriver::wait_for_state(RTC::LifeCycleState wanted, const char* verb) const {
    const auto deadline = std::chrono::steady_clock::now() + timeout_;
    auto now = state();
    while (now != wanted && now != RTC::ERROR_STATE && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        now = state();
    }
    if (now == wanted) return "";
    if (now == RTC::ERROR_STATE) return name_ + " went to ERROR; its own messages say why";
    return fmt::format("{} is {} and was not {} within {} ms", name_, name_of(now), verb, timeout_.count());
}

} // namespace tandem::interceptor
