// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/port_faults.hpp"

#include <algorithm>

namespace tandem::command {
namespace {

using nlohmann::json;

struct Listed {
    const engine::SourceLocation& location;
    std::string kind, name, direction, type; ///< type: empty if it says nothing
};

std::vector<Listed> listed_ports(const engine::ComponentProfile& profile) {
    std::vector<Listed> all;
    for (const auto& port : profile.data_ports)
        all.push_back({port.location, "data", port.name, port.is_input ? "input" : "output", port.data_type});
    for (const auto& port : profile.event_ports)
        all.push_back(
            {port.location, "event", port.name, port.is_input ? "input" : "output", port.data_type});
    for (const auto& port : profile.service_ports) // the type is a file's name there, of no use here
        all.push_back({port.location, "service", port.name, port.is_provided ? "provided" : "required", ""});
    return all;
}

// `vector< unsigned char >` and std::vector<unsigned char> are the same.
std::string without_spelling(std::string type) {
    type.erase(std::remove_if(type.begin(), type.end(), [](unsigned char c) { return std::isspace(c); }),
               type.end());
    for (auto at = type.find("std::"); at != std::string::npos; at = type.find("std::")) type.erase(at, 5);
    return type;
}

const json* find(const json& ports, const std::string& kind, const std::string& name) {
    const json* found = nullptr; // of another kind
    for (const json& port : ports) {
        if (port["name"] != name) continue;
        if (port["kind"] == kind) return &port;
        found = &port;
    }
    return found;
}

std::string names(const json& ports, const std::string& kind) {
    std::string text;
    for (const json& port : ports)
        if (port["kind"] == kind) text += (text.empty() ? "" : ", ") + port["name"].get<std::string>();
    return text.empty() ? "none" : text;
}

/// Empty if it fits.
std::string fault(const Listed& listed, const json& ports, bool initialized) {
    const std::string what = listed.kind + " port '" + listed.name + "' ";
    const json* real = find(ports, listed.kind, listed.name);
    if (!real)
        return what + "is not in the component, its " + listed.kind +
               " ports are: " + names(ports, listed.kind) +
               (initialized ? "" : " (and those that onInitialize makes, see --initialize)");
    const std::string kind = (*real)["kind"], direction = (*real)["direction"];
    if (kind != listed.kind) return what + "is of kind " + kind + " in the component";
    if (direction != listed.direction)
        return what + "is " + direction + " in the component, not " + listed.direction;
    if (listed.type.empty() || !real->contains("type") || (*real)["type"].is_null()) return "";
    const std::string type = (*real)["type"];
    if (without_spelling(type) == without_spelling(listed.type)) return "";
    return what + "is " + type + " in the component, not " + listed.type;
}

} // namespace

std::vector<std::string> port_faults(const engine::ComponentProfile& profile, const json& ports,
                                     bool initialized) {
    std::vector<std::string> faults = profile.port_errors;
    for (const Listed& listed : listed_ports(profile))
        if (const std::string text = fault(listed, ports, initialized); !text.empty())
            faults.push_back(listed.location.text() + ": " + text);
    return faults;
}

} // namespace tandem::command
