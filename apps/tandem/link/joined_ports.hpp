// SPDX-License-Identifier: Apache-2.0
// Finds the ports on both sides of an application's links, and the configured peer of each port.
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/run/run_folder.hpp"
#include "host/opros/engine/profile/application_profile.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tandem::command {

/// A component of the application: an OPRoS component, or the RTC behind an AdaptorComp.
// NOLINTNEXTLINE(bugprone-exception-escape): the check takes the assertions of nlohmann's move constructor for throws
struct JoinedComponent {
    engine::Subcomponent entry;
    nlohmann::json ports; ///< from describe_component(), with a "signature" of the data on the link
    std::string link;     ///< for an AdaptorComp; otherwise empty
    std::string rtc;      ///< the RTC behind it
    bool running = false; ///< an RTM host is sharing these ports now
    std::map<std::string, std::string> properties{}; ///< for an AdaptorComp
    /// Returns the name that users know: the RTC's name for an AdaptorComp.
    const std::string& name() const { return link.empty() ? entry.name : rtc; }
};

struct JoinedPorts {
    engine::ApplicationProfile application;
    std::map<std::string, JoinedComponent> components; ///< by their names in the application
    std::vector<std::string> connection_errors;        ///< one per connection; empty if it is possible
    /// For each unconnected port (COMPONENT.PORT in the application): unconnected ports on the other side of a link
    /// that fit it.
    std::map<std::string, std::vector<engine::PortReference>> suggestions;
    std::vector<std::string> errors; ///< reasons why a component or link could not be inspected
};

/// Finds the ports of all components and tries each connection in a child process. The ports of RTCs come from running
/// hosts, or otherwise from the rtc.conf. Throws std::runtime_error if the application cannot be read.
JoinedPorts find_joined_ports(const RunFolder& folder, const InspectOptions& options);

} // namespace tandem::command
