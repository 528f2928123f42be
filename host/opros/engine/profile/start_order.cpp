// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/profile/start_order.hpp"

#include <algorithm>

namespace tandem::engine {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Nullptr when all that the component depends on are among the names.
const Dependency* unmet(const ApplicationProfile& profile, const std::string& name,
                        const std::vector<std::string>& done) {
    for (const Dependency& dependency : profile.dependencies)
        if (dependency.source == name && !contains(done, dependency.target)) return &dependency;
    return nullptr;
}

} // namespace

std::vector<std::string> start_order(const ApplicationProfile& profile) {
    std::vector<std::string> order;
    while (order.size() < profile.subcomponents.size()) {
        const std::size_t before = order.size();
        const Dependency* missing = nullptr;
        for (auto entry = profile.subcomponents.rbegin(); entry != profile.subcomponents.rend(); ++entry) {
            if (contains(order, entry->name)) continue;
            if (const Dependency* dependency = unmet(profile, entry->name, order))
                missing = dependency;
            else
                order.push_back(entry->name);
        }
        if (order.size() == before)
            throw SetupError(missing->location, "component '" + missing->source + "' depends on '" +
                                                    missing->target + "' in a circle");
    }
    return order;
}

} // namespace tandem::engine
