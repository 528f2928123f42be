// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/manager/slow_transitions.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/naming/component_creation.hpp"
#include <algorithm>
#include <array>
#include <atomic>
#include <coil/stringutil.h>
#include <rtm/ExecutionContextBase.h>

namespace RTC {
namespace {

using tandem::crash::find_running_callback;

std::atomic<int> transitions_under_way{0};

/// What the component's first context reports about it. Asked through the CORBA object, because another thread may be
/// about to finalize the component and its contexts.
struct ContextState {
    std::string state; ///< empty: it no longer has a context
    double rate = 0;
};

ContextState state_of(RTObject_impl& component) {
    try {
        ExecutionContextList_var contexts = component.get_owned_contexts();
        if (contexts->length() == 0) return {};
        RTObject_var self = component.getObjRef();
        const LifeCycleState state = contexts[0]->get_component_state(self.in());
        return {state == CREATED_STATE ? "" : ExecutionContextBase::getStateString(state),
                contexts[0]->get_rate()};
    } catch (const CORBA::SystemException&) {
        return {};
    }
}

} // namespace

bool is_transition_callback(const std::string& name) {
    static const std::array<const char*, 7> names{"onInitialize", "onStartup", "onActivated", "onDeactivated",
                                                  "onAborting",   "onReset",   "onShutdown"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

TransitionScope::TransitionScope() {
    ++transitions_under_way;
    wake_main_loop();
}
TransitionScope::~TransitionScope() { --transitions_under_way; }

bool SlowTransitions::needs_check() const { return transitions_under_way > 0 || !slow_.empty(); }

void SlowTransitions::expect_end(const RTObject_impl& component) {
    if (const auto running = find_running_callback(&component)) slow_[&component] = {*running};
}

std::vector<std::string> SlowTransitions::check(const std::vector<RTObject_impl*>& components) {
    std::vector<std::string> lines;
    for (auto* component : components) {
        const auto running = find_running_callback(component);
        if (running && is_transition_callback(running->name) && running->seconds() >= first_report.count())
            slow_.try_emplace(component, Slow{*running});
        const auto found = slow_.find(component);
        if (found == slow_.end()) continue;
        const std::string line = report(*component, found->second);
        if (!line.empty()) lines.push_back(line);
        if (!line.empty() && found->second.end != Clock::time_point()) slow_.erase(found);
    }
    std::erase_if(slow_, [&](const auto& slow) {
        return std::find(components.begin(), components.end(), slow.first) == components.end();
    });
    return lines;
}

// Returns the line that is due for a callback that was slow a moment ago; empty if there is none.
std::string SlowTransitions::report(RTObject_impl& component, Slow& slow) {
    const std::string name = component.getInstanceName();
    const auto running = find_running_callback(&component);
    if (running && running->since == slow.callback.since) {
        if (Clock::now() - slow.callback.since < slow.next_report) return "";
        const auto seconds = static_cast<long>(slow.next_report.count());
        slow.next_report *= 2;
        return coil::sprintf("%s of %s has taken %ld s so far%s", slow.callback.name, name.c_str(), seconds,
                             static_cast<double>(seconds) < hanging_after_s ? "" : hanging_text);
    }
    if (slow.end == Clock::time_point()) slow.end = Clock::now();
    // A callback that fails leads to ERROR only in the next cycle, so the state is read after that cycle. The time
    // limit is for contexts with periods of hours.
    const ContextState now = state_of(component);
    const double settling_s = now.state.empty() ? 0 : std::min(2 / now.rate, 5.0);
    if (std::chrono::duration<double>(Clock::now() - slow.end).count() < settling_s) return "";
    const std::chrono::duration<double> taken = slow.end - slow.callback.since;
    return coil::sprintf("%s of %s has returned within %.1f s", slow.callback.name, name.c_str(),
                         taken.count()) +
           (now.state.empty() ? "" : "; " + name + " is " + now.state);
}

} // namespace RTC
