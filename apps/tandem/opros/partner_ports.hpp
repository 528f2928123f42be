// SPDX-License-Identifier: Apache-2.0
// AdaptorComp, the OPRoS side of the proxy, has the ports of the RTC behind its link: what they are depends on the
// other host.
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"
#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

/// Whether this library is AdaptorComp.
bool is_adaptor(const std::filesystem::path& library);

/// The link that an AdaptorComp of the application joins, by its properties. Throws engine::SetupError without one.
std::string adaptor_link(const engine::Subcomponent& entry, const engine::ComponentProfile& profile);

} // namespace tandem::command
