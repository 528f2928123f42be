// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/port_mismatches.hpp"

#include <algorithm>

namespace tandem::command {
namespace {

using nlohmann::json;

/// A port in the profile.
struct ProfilePort {
    const engine::SourceLocation& location;
    std::string kind, name, direction, type; ///< type: "" if the profile has none
};

// Returns the ports of all three kinds in one list.
std::vector<ProfilePort> profile_ports(const engine::ComponentProfile& profile) {
    std::vector<ProfilePort> all;
    for (const auto& port : profile.data_ports)
        all.push_back({port.location, "data", port.name, port.is_input ? "input" : "output", port.data_type});
    for (const auto& port : profile.event_ports)
        all.push_back(
            {port.location, "event", port.name, port.is_input ? "input" : "output", port.data_type});
    for (const auto& port : profile.service_ports) // the <type> of a service is a file name
        all.push_back({port.location, "service", port.name, port.is_provided ? "provided" : "required", ""});
    return all;
}

// Removes white space and std::, because profiles spell types freely, for example `vector< unsigned char >`.
std::string normalized_type(std::string type) {
    type.erase(std::remove_if(type.begin(), type.end(), [](unsigned char c) { return std::isspace(c); }),
               type.end());
    for (auto at = type.find("std::"); at != std::string::npos; at = type.find("std::")) type.erase(at, 5);
    return type;
}

// Returns the port with this name, preferably of this kind; nullptr if there is none.
const json* find_port(const json& ports, const std::string& kind, const std::string& name) {
    const json* found = nullptr;
    for (const json& port : ports) {
        if (port["name"] != name) continue;
        if (port["kind"] == kind) return &port;
        found = &port;
    }
    return found;
}

// Returns the names of all ports of a kind, for messages.
std::string join_names(const json& ports, const std::string& kind) {
    std::string text;
    for (const json& port : ports)
        if (port["kind"] == kind) text += (text.empty() ? "" : ", ") + port["name"].get<std::string>();
    return text.empty() ? "none" : text;
}

/// Returns the mismatch of a listed port; "" if it fits.
std::string describe_mismatch(const ProfilePort& profile_port, const json& ports, bool initialized) {
    const std::string what = profile_port.kind + " port '" + profile_port.name + "' ";
    const json* real = find_port(ports, profile_port.kind, profile_port.name);
    // Without onInitialize this may not be an error; the message says how to check.
    if (!real)
        return what + "does not exist in the component; its " + profile_port.kind +
               " ports are: " + join_names(ports, profile_port.kind) +
               (initialized ? "" : " (to see ports created by onInitialize(), use --initialize)");
    const std::string kind = (*real)["kind"], direction = (*real)["direction"];
    if (kind != profile_port.kind) return what + "has kind " + kind + " in the component";
    if (direction != profile_port.direction)
        return what + "is " + direction + " in the component, not " + profile_port.direction;
    // Compares types only if both exist: a port may carry any type, and a profile may omit the type.
    if (profile_port.type.empty() || !real->contains("type") || (*real)["type"].is_null()) return "";
    const std::string type = (*real)["type"];
    if (normalized_type(type) == normalized_type(profile_port.type)) return "";
    return what + "is " + type + " in the component, not " + profile_port.type;
}

} // namespace

std::vector<std::string> find_port_mismatches(const engine::ComponentProfile& profile, const json& ports,
                                              bool initialized) {
    std::vector<std::string> errors = profile.port_errors;
    for (const ProfilePort& profile_port : profile_ports(profile))
        if (const std::string text = describe_mismatch(profile_port, ports, initialized); !text.empty())
            errors.push_back(profile_port.location.text() + ": " + text);
    return errors;
}

} // namespace tandem::command
