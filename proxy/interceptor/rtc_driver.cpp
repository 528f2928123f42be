// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/rtc_driver.hpp"

#include "proxy/link/protocol/control.hpp"

#include <rtm/Manager.h>

#include <fmt/format.h>

#include <algorithm>

#include <stdexcept>
#include <thread>

namespace tandem::interceptor {
namespace control = link::control;
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
    : rtc_(rtc), name_(rtc.getInstanceName()), reference_(rtc.getObjRef()), timeout_(timeout),
      error_listener_(std::make_unique<CallbackListener>([report] { report("went to ERROR"); })),
      reset_listener_(std::make_unique<CallbackListener>([this] { reset_ended_ = true; })),
      exit_listener_(std::make_unique<CallbackListener>([this, report] {
          exited_ = true;
          report("has exited");
      })) {
    RTC::ExecutionContextList_var contexts = rtc.get_owned_contexts();
    if (contexts->length() == 0)
        throw std::runtime_error(
            fmt::format("RTC '{}' has no execution context of its own", rtc.getInstanceName()));
    // Contexts that the RTC was attached to later are driven by those who attached it.
    context_ = RTC::ExecutionContext::_duplicate(contexts[0]);
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
    if (exited_) return name_ + " has exited; start the RTM host again to have it back";
    // Not reset here: whether an error may be ignored is the user's decision.
    if (state() == RTC::ERROR_STATE) return name_ + " is in ERROR; reset it first";
    return transition_and_wait({RTC::INACTIVE_STATE, RTC::ACTIVE_STATE,
                                &RTC::_objref_ExecutionContext::activate_component, "activated",
                                "onActivated", std::max(timeout_, control::activation_timeout)});
}

std::string RtcDriver::deactivate() {
    const std::lock_guard lock(mutex_);
    if (state() != RTC::ACTIVE_STATE) return "";
    const std::string error = transition_and_wait(
        {RTC::ACTIVE_STATE, RTC::INACTIVE_STATE, &RTC::_objref_ExecutionContext::deactivate_component,
         "deactivated", "onDeactivated", std::max(timeout_, control::deactivation_timeout)});
    // Its host may be ending at the same time: an RTC that has left meanwhile is not active.
    return state() == RTC::CREATED_STATE ? "" : error;
}

std::string RtcDriver::reset() {
    const std::lock_guard lock(mutex_);
    if (state() != RTC::ERROR_STATE) return "";
    reset_ended_ = false;
    return transition_and_wait({RTC::ERROR_STATE, RTC::INACTIVE_STATE,
                                &RTC::_objref_ExecutionContext::reset_component, "reset", "onReset",
                                std::max(timeout_, control::deactivation_timeout)});
}

/// Asks the execution context for a transition and waits until it is done. Asks again while the context does
/// not accept it: a host that has just started may have created the RTC but not yet started its context.
std::string RtcDriver::transition_and_wait(const Transition& transition) {
    const auto deadline = std::chrono::steady_clock::now() + timeout_;
    try {
        auto result = RTC::PRECONDITION_NOT_MET;
        for (;;) {
            // Another client, a tool for instance, may have made the same transition meanwhile: that is fine.
            if (state() == transition.from) result = (context_->*transition.operation)(reference_);
            // RTC_ERROR: it has failed, or takes longer than the context waits for it (activation_timeout, 0.5 s).
            if (result == RTC::RTC_OK || result == RTC::RTC_ERROR || state() == transition.to)
                return wait_for_end(transition);
            if (result != RTC::PRECONDITION_NOT_MET || std::chrono::steady_clock::now() >= deadline) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return fmt::format("{} is {}, {} was expected, and it was not {}: its context answers {}", name_,
                           name_of(state()), name_of(transition.from), transition.verb,
                           static_cast<int>(result));
    } catch (const CORBA::Exception& error) { // the RTC or its context has left
        return fmt::format("{} was not {}: {}", name_, transition.verb, error._name());
    }
}

/// Waits, because a context carries out a transition in its next cycle only, and the RTC's callback may be slow.
std::string RtcDriver::wait_for_end(const Transition& transition) const {
    const auto deadline = std::chrono::steady_clock::now() + transition.timeout;
    const auto is_under_way = [&](RTC::LifeCycleState now) {
        if (now == transition.to) return false;
        return now != RTC::ERROR_STATE || (transition.from == RTC::ERROR_STATE && !reset_ended_);
    };
    auto now = state();
    while (is_under_way(now) && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        now = state();
    }
    if (now == transition.to) return "";
    if (!is_under_way(now))
        return fmt::format("{} is in ERROR: its {} has failed or it was aborted; its own messages say why",
                           name_, transition.callback);
    return fmt::format("{} is still {} and was not {} within {} ms: its {} is slow or hangs", name_,
                       name_of(now), transition.verb, transition.timeout.count(), transition.callback);
}

} // namespace tandem::interceptor
