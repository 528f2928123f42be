// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/partner_ports.hpp"

namespace tandem::command {

bool is_adaptor(const std::filesystem::path& library) { return library.stem() == "AdaptorComp"; }

std::string adaptor_link(const engine::Subcomponent& entry, const engine::ComponentProfile& profile) {
    std::string link;
    // As in the host: those of the application win.
    for (const auto* properties : {&profile.properties, &entry.properties})
        for (const auto& [name, value] : *properties)
            if (name == "link") link = value;
    if (link.empty())
        throw engine::SetupError(entry.location, "component '" + entry.name +
                                                     "': property 'link' is missing: give it the name that "
                                                     "InterceptorComp's 'link' has");
    return link;
}

} // namespace tandem::command
