// SPDX-License-Identifier: Apache-2.0
// AdaptorComp, the OPRoS side of the proxy, has the ports of the RTC behind its link: what they are depends on the
// other host.
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"
#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace tandem::command {

/// Whether this library is AdaptorComp.
bool is_adaptor(const std::filesystem::path& library);

/// The link that an AdaptorComp of the application joins, by its properties. Throws engine::SetupError without one.
std::string adaptor_link(const engine::Subcomponent& entry, const engine::ComponentProfile& profile);

/// The properties that an AdaptorComp of the application has: those of its profile, and those of the application, which
/// replace them.
std::map<std::string, std::string> adaptor_properties(const engine::Subcomponent& entry,
                                                      const engine::ComponentProfile& profile);
/// The names in its property `event_ports`.
std::set<std::string> event_ports(const std::map<std::string, std::string>& properties);

} // namespace tandem::command
