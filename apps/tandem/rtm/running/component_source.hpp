// SPDX-License-Identifier: Apache-2.0
// Lists all components in name servers and managers.
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"

namespace tandem::command {

/// A component in a name server or a manager, with its own answers.
struct ComponentEntry {
    std::string address; ///< rtcname://... or rtcloc://...
    std::string instance, type, state, category;
    std::string callback; ///< `onActivated has taken 1.3 s so far`, or empty
    std::string describe_state() const { return state + (callback.empty() ? "" : " (" + callback + ")"); }
    CORBA::ULong ports = 0;
    RTC::RTObject_var object; ///< nil: its manager is still creating it
    std::string error;        ///< "" if it answers; otherwise only the address is valid
};

/// A name server or a manager, and its components.
struct ComponentSource {
    std::string kind;    ///< name server, manager
    std::string address; ///< host:port
    std::string error;   ///< why it does not answer, with its kind and address; otherwise ""
    std::vector<ComponentEntry> components;
};

/// Queries all name servers and managers of the client. Lists a component with each source that knows it. Lists a
/// component that does not answer, for example because its process has died, with its error. Does not throw for sources
/// that do not answer.
std::vector<ComponentSource> enumerate_components(const RtmClient& client);

/// Reads the ports and connections of a source's components: [{"instance", "address", "state", "error", "ports": [{"name",
/// "kind", "type", "connected_with", "properties", "connections": [{"id", "name", "with", "properties"}]}]}].
nlohmann::json describe_components(const ComponentSource& source);

/// Throws std::runtime_error with one line if no source has answered, or if a source that the user named has not.
void throw_if_sources_failed(const RtmClient& client, const std::vector<ComponentSource>& sources);

} // namespace tandem::command
