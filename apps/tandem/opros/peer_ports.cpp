// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/peer_ports.hpp"

#include "host/text/split_names.hpp"

namespace tandem::command {

bool is_adaptor(const std::filesystem::path& library) { return library.stem() == "AdaptorComp"; }

std::map<std::string, std::string> adaptor_properties(const engine::Subcomponent& entry,
                                                      const engine::ComponentProfile& profile) {
    std::map<std::string, std::string> all;
    // As in the host, the application's properties override the profile's.
    for (const auto* properties : {&profile.properties, &entry.properties})
        for (const auto& [name, value] : *properties) all[name] = value;
    return all;
}

std::set<std::string> event_ports(const std::map<std::string, std::string>& properties) {
    const auto found = properties.find("event_ports");
    if (found == properties.end()) return {};
    const auto names = text::split_names(found->second);
    return {names.begin(), names.end()};
}

std::string adaptor_link(const engine::Subcomponent& entry, const engine::ComponentProfile& profile) {
    std::string link = adaptor_properties(entry, profile)["link"];
    if (link.empty())
        throw engine::SetupError(
            entry.location,
            "component '" + entry.name +
                "': property 'link' is missing: set it to the value of 'link' of InterceptorComp");
    return link;
}

} // namespace tandem::command
