// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/execution/configured_contexts.hpp"
#include <coil/stringutil.h>
#include <rtm/Manager.h>

namespace RTC {
namespace {

// Merges a node of the component's properties into `to`, when it exists.
void add_node(coil::Properties& to, const coil::Properties& from, const std::string& node) {
    if (const auto* found = from.findNode(node)) to << *found;
}

// The options below `exec_cxt` that hold for contexts of all types.
coil::Properties common_options(const coil::Properties& component) {
    coil::Properties options;
    for (const char* key :
         {"sync_transition", "sync_activation", "sync_deactivation", "sync_reset", "transition_timeout",
          "activation_timeout", "deactivation_timeout", "reset_timeout", "cpu_affinity", "priority"}) {
        const std::string value = component.getProperty(std::string("exec_cxt.") + key);
        if (!value.empty()) options.setProperty(key, value);
    }
    return options;
}

} // namespace

std::vector<coil::Properties> configured_contexts(const coil::Properties& component) {
    std::vector<coil::Properties> contexts;
    const auto listed = coil::split(component.getProperty("execution_contexts"), ",", true);
    for (const auto& entry : listed) {
        // `none` anywhere in the list: contexts of other components run the component, as for a member of a composite.
        if (coil::normalize(entry) == "none") return {};
        const std::size_t open = entry.find('(');
        if (open != std::string::npos && entry.back() != ')')
            throw ManagerError("execution_contexts: expected type or type(name), found " + entry);
        // From the general to the specific, so that later settings override earlier ones.
        coil::Properties options = common_options(component);
        add_node(options, component, "exec_cxt.periodic");
        const std::string type = coil::eraseBothEndsBlank(entry.substr(0, open));
        add_node(options, component, "ec." + type);
        if (open != std::string::npos) {
            const std::string name =
                coil::eraseBothEndsBlank(entry.substr(open + 1, entry.size() - open - 2));
            add_node(options, component, "ec." + name);
            options.setProperty("name", name);
        }
        options.setProperty("type", type);
        contexts.push_back(options);
    }
    if (!listed.empty()) return contexts;
    // The syntax of OpenRTM-aist 1.x: one context, which is periodic unless exec_cxt.periodic.type names another type.
    coil::Properties options = common_options(component);
    add_node(options, component, "exec_cxt.periodic");
    const std::string type = options.getProperty("type", "PeriodicExecutionContext");
    add_node(options, component, "ec." + type);
    options.setProperty("type", type);
    return {options};
}

} // namespace RTC
