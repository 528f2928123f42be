// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/start_order.hpp"

#include <algorithm>

namespace tandem::engine {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns a dependency of the component that is not in the order yet, or nullptr if there is none.
const Dependency* find_unmet_dependency(const ApplicationProfile& profile, const std::string& name,
                                        const std::vector<std::string>& order) {
    for (const Dependency& dependency : profile.dependencies)
        if (dependency.source == name && !contains(order, dependency.target)) return &dependency;
    return nullptr;
}

} // namespace

std::vector<std::string> start_order(const ApplicationProfile& profile) {
    std::vector<std::string> order;
    // Each pass adds what it can. A pass that adds nothing while components are left proves a dependency cycle.
    while (order.size() < profile.subcomponents.size()) {
        const std::size_t size_before = order.size();
        const Dependency* unmet = nullptr;
        for (auto entry = profile.subcomponents.rbegin(); entry != profile.subcomponents.rend(); ++entry) {
            if (contains(order, entry->name)) continue;
            if (const Dependency* dependency = find_unmet_dependency(profile, entry->name, order))
                unmet = dependency;
            else
                order.push_back(entry->name);
        }
        if (order.size() == size_before)
            throw SetupError(unmet->location, "circular dependency: component '" + unmet->source +
                                                  "' depends on '" + unmet->target + "'");
    }
    return order;
}

} // namespace tandem::engine
