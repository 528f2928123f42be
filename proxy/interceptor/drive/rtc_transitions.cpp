// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/drive/rtc_transitions.hpp"

#include "proxy/link/protocol/control.hpp"

#include <fmt/format.h>
#include <rtm/NVUtil.h>

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

RTC::ExecutionContext_ptr own_context(const std::string& name, const RTC::ExecutionContextList& owned) {
    if (owned.length() == 0)
        throw std::runtime_error(fmt::format("RTC '{}' owns no execution context", name));
    return RTC::ExecutionContext::_duplicate(owned[0]);
}

RtcTransitions::RtcTransitions(std::string name, RTC::RTObject_ptr rtc, RTC::ExecutionContext_ptr context,
                               std::chrono::milliseconds timeout, std::chrono::milliseconds pause)
    : name_(std::move(name)), reference_(RTC::RTObject::_duplicate(rtc)),
      context_(RTC::ExecutionContext::_duplicate(context)), timeout_(timeout), pause_(pause) {}

RTC::LifeCycleState RtcTransitions::state() const {
    try {
        return context_.in()->get_component_state(reference_.in());
    } catch (const CORBA::Exception&) {
        return RTC::CREATED_STATE; // it was deleted; no transition accepts this state
    }
}

std::string RtcTransitions::activate() {
    const std::lock_guard lock(mutex_);
    if (state() == RTC::ACTIVE_STATE) return "";
    // Not reset here: whether an error may be ignored is the user's decision.
    if (state() == RTC::ERROR_STATE) return name_ + " is in ERROR; reset it first";
    return transition_and_wait({RTC::INACTIVE_STATE, RTC::ACTIVE_STATE,
                                &RTC::_objref_ExecutionContext::activate_component, "activated",
                                "onActivated", std::max(timeout_, control::activation_timeout)});
}

std::string RtcTransitions::deactivate() {
    const std::lock_guard lock(mutex_);
    if (state() != RTC::ACTIVE_STATE) return "";
    const std::string error = transition_and_wait(
        {RTC::ACTIVE_STATE, RTC::INACTIVE_STATE, &RTC::_objref_ExecutionContext::deactivate_component,
         "deactivated", "onDeactivated", std::max(timeout_, control::deactivation_timeout)});
    // Its host may be ending at the same time: an RTC that has left meanwhile is not active.
    return state() == RTC::CREATED_STATE ? "" : error;
}

std::string RtcTransitions::reset() {
    const std::lock_guard lock(mutex_);
    if (state() != RTC::ERROR_STATE) return "";
    reset_ended_ = false;
    return transition_and_wait({RTC::ERROR_STATE, RTC::INACTIVE_STATE,
                                &RTC::_objref_ExecutionContext::reset_component, "reset", "onReset",
                                std::max(timeout_, control::deactivation_timeout)});
}

/// Asks the execution context for a transition and waits until it is done. Asks again while the context does
/// not accept it: a host that has just started may have created the RTC but not yet started its context.
std::string RtcTransitions::transition_and_wait(const Transition& transition) {
    const auto deadline = std::chrono::steady_clock::now() + timeout_;
    try {
        auto result = RTC::PRECONDITION_NOT_MET;
        for (;;) {
            // Another client, a tool for instance, may have made the same transition meanwhile: that is fine.
            if (state() == transition.from) result = (context_.in()->*transition.operation)(reference_.in());
            // RTC_ERROR: it has failed, or takes longer than the context waits for it (activation_timeout, 0.5 s).
            if (result == RTC::RTC_OK || result == RTC::RTC_ERROR || state() == transition.to)
                return wait_for_end(transition);
            if (result != RTC::PRECONDITION_NOT_MET || std::chrono::steady_clock::now() >= deadline) break;
            std::this_thread::sleep_for(pause_);
        }
        return fmt::format("{} is {} instead of {}, and it was not {}: its context answers {}", name_,
                           name_of(state()), name_of(transition.from), transition.verb,
                           static_cast<int>(result));
    } catch (const CORBA::Exception& error) { // the RTC or its context has left
        return fmt::format("{} was not {}: {}", name_, transition.verb, error._name());
    }
}

RTC::LifeCycleState RtcTransitions::wait_for_change(RTC::LifeCycleState from) const {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    auto now = state();
    for (; now == from && std::chrono::steady_clock::now() < deadline; now = state())
        std::this_thread::sleep_for(pause_);
    return now;
}

/// Waits, because a context carries out a transition in its next cycle only, and the RTC's callback may be slow.
std::string RtcTransitions::wait_for_end(const Transition& transition) const {
    const auto deadline = std::chrono::steady_clock::now() + transition.timeout;
    const auto is_under_way = [&](RTC::LifeCycleState now) {
        if (now == transition.to) return false;
        return now != RTC::ERROR_STATE || (transition.from == RTC::ERROR_STATE && !reset_ended_);
    };
    auto now = state();
    while (is_under_way(now) && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(pause_);
        now = state();
    }
    if (now == transition.to) return "";
    const auto [failed, running] = callbacks();
    if (!is_under_way(now))
        return failed.empty()
                   ? fmt::format(
                         "{} is in ERROR: its {} has failed or it was aborted; its own messages say why",
                         name_, transition.callback)
                   : fmt::format("{} is in ERROR: its {} has failed; its own messages say why", name_,
                                 failed);
    return fmt::format("{} is still {} and was not {} within {} ms: its {} is slow or hangs", name_,
                       name_of(now), transition.verb, transition.timeout.count(),
                       running.empty() ? std::string(transition.callback) + " or the callback before it"
                                       : running);
}

// Only rtm_host reports callbacks; a manager of OpenRTM-aist does not.
RtcTransitions::Callbacks RtcTransitions::callbacks() const {
    const std::string instance = name_.substr(name_.rfind('/') + 1);
    try {
        RTC::ExecutionContextService_var service = RTC::ExecutionContextService::_narrow(context_.in());
        if (CORBA::is_nil(service.in())) return {};
        RTC::ExecutionContextProfile_var profile = service->get_profile();
        const bool is_running = NVUtil::toString(profile->properties, "callback.component") == instance;
        return {NVUtil::toString(profile->properties, ("failed." + instance).c_str()),
                is_running ? NVUtil::toString(profile->properties, "callback.name") : ""};
    } catch (const CORBA::Exception&) {
        return {};
    }
}

} // namespace tandem::interceptor
