// SPDX-License-Identifier: Apache-2.0
// AdaptorComp, the OPRoS side of the proxy, has the ports of the RTC behind its link: what they are depends on the
// other host.
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace tandem::command {

/// Whether this library is AdaptorComp.
bool is_adaptor(const std::filesystem::path& library);

/// The link that an AdaptorComp of the application joins, by its properties. Throws engine::SetupError without one.
std::string adaptor_link(const engine::Subcomponent& entry, const engine::ComponentProfile& profile);

/// The ports that the RTM host shares on this link at the moment, read from shared memory without taking part; nothing if
/// no running host does. Throws std::runtime_error: the name is not that of a link, or what is there is damaged.
std::optional<link::PortTable> read_shared_ports(const std::string& link);

/// The mirrors of these ports as describe_component() describes ports, without types: those are compared when the ports
/// are connected.
nlohmann::json describe_mirrors(const link::PortTable& table);

} // namespace tandem::command
