// SPDX-License-Identifier: Apache-2.0
// The two sides of the links of an application: which port has which peer, as the configuration says.
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/run/run_folder.hpp"
#include "host/opros/engine/profile/application_profile.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tandem::command {

/// A component of the application: an OPRoS component, or the RTC that an AdaptorComp stands for.
// NOLINTNEXTLINE(bugprone-exception-escape): the check takes the assertions of nlohmann's move constructor for throws
struct JoinedComponent {
    engine::Subcomponent entry;
    nlohmann::json ports; ///< as describe_component() gives them, with a "signature" of what crosses the link
    std::string link;     ///< of an AdaptorComp, otherwise empty
    std::string rtc;      ///< the RTC behind it
    bool running = false; ///< an RTM host shares these ports now
    std::map<std::string, std::string> properties{}; ///< of an AdaptorComp
    /// As the user knows the component: the RTC's name for an AdaptorComp.
    const std::string& name() const { return link.empty() ? entry.name : rtc; }
};

struct JoinedPorts {
    engine::ApplicationProfile application;
    std::map<std::string, JoinedComponent> components; ///< by their names in the application
    std::vector<std::string> connection_errors;        ///< by connection; empty for one that can be made
    /// Of ports that no connection names: such ports on the other side of a link that they could be connected with, by
    /// COMPONENT.PORT of the application.
    std::map<std::string, std::vector<engine::PortReference>> suggestions;
    std::vector<std::string> errors; ///< what keeps a component or a link from being looked at
};

/// Finds out the ports of all components, those of RTCs from hosts that run or else from the rtc.conf, and tries each
/// connection in a child process. Throws std::runtime_error if the application cannot be read.
JoinedPorts find_joined_ports(const RunFolder& folder, const InspectOptions& options);

} // namespace tandem::command
