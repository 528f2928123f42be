// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <chrono>
#include <fmt/format.h>
#include <thread>

namespace tandem::command {
namespace {

// A reset leads from ERROR to INACTIVE, as a deactivation does from ACTIVE.
const char* target_state(Transition transition) {
    return transition == Transition::activate ? "ACTIVE" : "INACTIVE";
}

// Not for Transition::exit, which is an operation of the component and not of a context.
RTC::ReturnCode_t request_transition(RTC::ExecutionContext_ptr context, RTC::RTObject_ptr component,
                                     Transition transition) {
    switch (transition) {
    case Transition::activate:
        return context->activate_component(component);
    case Transition::deactivate:
        return context->deactivate_component(component);
    default:
        return context->reset_component(component);
    }
}

// Waits until the component is in the wanted state or in ERROR, and returns the last state seen. Polls, because the
// context carries a transition out in its next cycle, which may be after it has answered the request.
std::string wait_for_state(const RemoteComponent& component, const std::string& wanted, double timeout_s) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
    for (;;) {
        std::string state = component_state(component.object.in());
        if (state == wanted || state == "ERROR" || std::chrono::steady_clock::now() > end) return state;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

// Requests the transition from the first context of the component, as rtshell does. Returns the state that was reached.
std::string apply_transition(const RemoteComponent& component, Transition transition, double timeout_s) {
    if (transition == Transition::exit) {
        const RTC::ReturnCode_t code = component.object->exit();
        if (code != RTC::RTC_OK)
            throw std::runtime_error(component.instance + " does not exit: " + to_string(code));
        return "exited";
    }
    std::string wanted = target_state(transition);
    // Asking an active component to activate would be refused. A reset is requested in any state: only the
    // component knows whether it applies.
    if (component_state(component.object.in()) == wanted && transition != Transition::reset) return wanted;
    const auto contexts = execution_contexts(component.object.in());
    const RTC::ReturnCode_t code =
        request_transition(contexts.front().in(), component.object.in(), transition);
    // After a refusal the state is looked at once: another client may have brought the component there.
    std::string state = wait_for_state(component, wanted, code == RTC::RTC_OK ? timeout_s : 0);
    if (state == wanted) return state;
    const char* hint = state == "ERROR" ? "; see its log, then tandem rtm reset" : "";
    throw std::runtime_error(fmt::format("{} is {}, expected {}{}{}", component.instance, state, wanted,
                                         code == RTC::RTC_OK ? "" : ": " + to_string(code), hint));
}

} // namespace

int rtm_transition(const RtmClientOptions& options, const std::vector<std::string>& names,
                   Transition transition) {
    const RtmClient client(options);
    nlohmann::json json = nlohmann::json::array();
    for (const auto& name : names) {
        // Found one by one: those before a name that does not exist have changed already.
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
