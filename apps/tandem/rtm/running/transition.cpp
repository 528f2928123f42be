// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/running/context_info.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <chrono>
#include <fmt/format.h>
#include <thread>

namespace tandem::command {
namespace {

using Clock = std::chrono::steady_clock;

/// The words of messages about a transition to `state`.
struct Wording {
    const char* state;
    const char* callback; ///< the component's callback that the transition waits for
    const char* verb;
    const char* participle;
    const char* opposite_callback; ///< callback of the opposite transition
};

// A reset leads from ERROR to INACTIVE, and a deactivation from ACTIVE to INACTIVE.
Wording wording(Transition transition) {
    switch (transition) {
    case Transition::activate:
        return {"ACTIVE", "onActivated", "activating", "activated", "onDeactivated"};
    case Transition::deactivate:
        return {"INACTIVE", "onDeactivated", "deactivating", "deactivated", "onActivated"};
    case Transition::reset:
        return {"INACTIVE", "onReset", "resetting", "reset", ""};
    default:
        return {"", "", "exiting", "", ""};
    }
}

// Not for Transition::exit, an operation of the component instead of a context. Also returns RTC_ERROR if the context
// has not answered in time: it is still waiting for the component.
RTC::ReturnCode_t request_transition(RTC::ExecutionContext_ptr context, RTC::RTObject_ptr component,
                                     Transition transition) {
    try {
        switch (transition) {
        case Transition::activate:
            return context->activate_component(component);
        case Transition::deactivate:
            return context->deactivate_component(component);
        default:
            return context->reset_component(component);
        }
    } catch (const CORBA::TIMEOUT&) {
        return RTC::RTC_ERROR;
    }
}

/// Requests a transition and waits for its end.
class TransitionRequest {
  public:
    TransitionRequest(const RemoteComponent& component, Transition transition, double timeout_s)
        : component_(component), transition_(transition), words_(wording(transition)),
          deadline_(start_ +
                    std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_s))),
          context_(execution_contexts(component.object.in()).front()) {}

    /// Returns the new state. Throws std::runtime_error if the component is in ERROR, refuses, or is not
    /// done in time.
    std::string apply() {
        wait_for_opposite_transition();
        // An active component would refuse to activate. A reset is requested in any state, because only the
        // component knows whether it applies.
        std::string state = component_state(component_.object.in());
        if (state == words_.state && transition_ != Transition::reset) return state;
        code_ = request_transition(context_.in(), component_.object.in(), transition_);
        state = component_state(component_.object.in());
        while (state != words_.state && is_under_way(state)) {
            if (Clock::now() > deadline_) throw_error(state);
            // Polls, because a context answers before it carries out the transition.
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            state = component_state(component_.object.in());
        }
        // If onActivated fails, the component stays ACTIVE until the next cycle and then enters ERROR.
        if (state == "ACTIVE") {
            std::this_thread::sleep_for(std::chrono::duration<double>(2 * info().period_s()));
            state = component_state(component_.object.in());
        }
        if (state != words_.state) throw_error(state);
        return state;
    }

  private:
    ContextInfo info() const { return ContextInfo(context_.in()); }
    std::string running_callback() const { return info().describe_running_callback(component_.instance); }

    // A component that is still activating is INACTIVE and would refuse to be deactivated. It will be
    // ACTIVE soon.
    void wait_for_opposite_transition() const {
        while (*words_.opposite_callback != '\0' &&
               info().running_callback(component_.instance) == words_.opposite_callback) {
            if (Clock::now() > deadline_)
                throw std::runtime_error(
                    fmt::format("{} cannot be {} yet: its {}; allow more time with --timeout",
                                component_.instance, words_.participle, running_callback()));
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }

    // Returns whether the transition may still complete. RTC_ERROR means that it failed, or that it takes
    // longer than the context waits.
    bool is_under_way(const std::string& state) const {
        if (code_ != RTC::RTC_OK && code_ != RTC::RTC_ERROR)
            return !running_callback().empty(); // requested by another client
        if (state != "ERROR") return true;
        if (transition_ != Transition::reset) return false;
        return info().reports_callbacks() ? !running_callback().empty() : code_ == RTC::RTC_ERROR;
    }

    [[noreturn]] void throw_error(const std::string& state) const {
        const std::chrono::duration<double> spent = Clock::now() - start_;
        const std::string running = running_callback();
        const std::string& name = component_.instance;
        if (!running.empty() && state != words_.state)
            throw std::runtime_error(fmt::format("{} is still {} after {:.1f} s: {}; if it is slow, allow "
                                                 "more time with --timeout; otherwise it hangs",
                                                 name, words_.verb, spent.count(), running));
        if (code_ != RTC::RTC_OK && code_ != RTC::RTC_ERROR)
            throw std::runtime_error(fmt::format("{} is {} and refuses to be {}: {}", name, state,
                                                 words_.participle, to_string(code_)));
        if (state == "ERROR")
            throw std::runtime_error(
                fmt::format("{} is in ERROR after {:.1f} s: its {}{} has failed; see its log, then "
                            "tandem rtm reset {}",
                            name, spent.count(), words_.callback,
                            transition_ == Transition::activate ? " or onExecute" : "", name));
        throw std::runtime_error(
            fmt::format("{} is still {} after {:.1f} s, expected {}: its {} has not returned, or its context "
                        "has not started it; allow more time with --timeout",
                        name, state, spent.count(), words_.state, words_.callback));
    }

    const RemoteComponent& component_;
    const Transition transition_;
    const Wording words_;
    const Clock::time_point start_ = Clock::now(), deadline_;
    RTC::ExecutionContext_var context_; // the component's first context, as in rtshell
    RTC::ReturnCode_t code_ = RTC::RTC_OK;
};

// An exit waits for the running callback, then for onDeactivated, onShutdown and onFinalize.
std::string exit_component(const RemoteComponent& component, double timeout_s) {
    const auto contexts = execution_contexts(component.object.in());
    try {
        const RTC::ReturnCode_t code = component.object->exit();
        if (code == RTC::RTC_OK) return "exited";
        throw std::runtime_error(component.instance + " does not exit: " + to_string(code));
    } catch (const CORBA::TIMEOUT&) {
        const std::string running =
            ContextInfo(contexts.front().in()).describe_running_callback(component.instance);
        throw std::runtime_error(
            fmt::format("{} is still exiting after {:.1f} s{}; allow more time with --timeout",
                        component.instance, timeout_s, running.empty() ? "" : ": " + running));
    }
}

std::string apply_transition(const RemoteComponent& component, Transition transition, double timeout_s) {
    if (transition == Transition::exit) return exit_component(component, timeout_s);
    return TransitionRequest(component, transition, timeout_s).apply();
}

} // namespace

int rtm_transition(const RtmClientOptions& options, const std::vector<std::string>& names,
                   Transition transition) {
    const RtmClient client(options);
    nlohmann::json json = nlohmann::json::array();
    for (const auto& name : names) {
        // Searched one by one, so components before a missing name are already changed.
        const RemoteComponent component = client.find_component(name);
        const std::string state = call_remote(
            component.address, [&] { return apply_transition(component, transition, options.timeout_s); });
        json.push_back({{"instance", component.instance}, {"address", component.address}, {"state", state}});
        if (!options.json) print_text(component.instance + " " + state + "\n");
    }
    if (options.json) print_json(json);
    return 0;
}

} // namespace tandem::command
