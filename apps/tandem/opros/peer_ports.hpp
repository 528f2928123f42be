// SPDX-License-Identifier: Apache-2.0
// AdaptorComp, the OPRoS side of the proxy, has the ports of the RTC behind its link. They depend on the other host.
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"
#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace tandem::command {

/// Returns whether this library is AdaptorComp.
bool is_adaptor(const std::filesystem::path& library);

/// Returns the link that an AdaptorComp joins according to its properties. Throws engine::SetupError if there is none.
std::string adaptor_link(const engine::Subcomponent& entry, const engine::ComponentProfile& profile);

/// Returns the properties of an AdaptorComp. The application's properties override the profile's.
std::map<std::string, std::string> adaptor_properties(const engine::Subcomponent& entry,
                                                      const engine::ComponentProfile& profile);
/// Returns the names in its property `event_ports`.
std::set<std::string> event_ports(const std::map<std::string, std::string>& properties);

} // namespace tandem::command
