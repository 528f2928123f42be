// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/description/profile_description.hpp"

#include "apps/tandem/opros/description/port_format.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/table.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/type_profile.hpp"

#include <fmt/format.h>
#include <map>

namespace tandem::command {
namespace {

using engine::ApplicationProfile;
using nlohmann::json;

// Returns the components of a composite or an application, each with its profile reference.
json describe_components(const ApplicationProfile& profile) {
    json components = json::array();
    for (const auto& entry : profile.subcomponents)
        components.push_back({{"name", entry.name}, {"profile", entry.reference}});
    return components;
}

// Returns the words that profiles and `opros info` use.
const char* port_kind(PortType type) {
    if (type == OPROS_DATA) return "data";
    return type == OPROS_EVENT ? "event" : "service";
}

json describe_application(const ApplicationProfile& profile) {
    json connections = json::array();
    for (const auto& each : profile.connections)
        connections.push_back(
            {{"kind", port_kind(each.type)}, {"from", each.source.text()}, {"to", each.target.text()}});
    return {{"kind", "application"},
            {"name", profile.name},
            {"components", describe_components(profile)},
            {"connections", connections}};
}

/// Returns the exported ports of a composite with their types. The components may be nested at any depth.
class ExportedPorts {
  public:
    ExportedPorts(const ApplicationProfile& composite, const InspectOptions& options)
        : composite_(composite), options_(options) {}

    json all() {
        json ports = json::array();
        for (const auto& each : composite_.exports) ports.push_back(described_port(each));
        return ports;
    }

  private:
    json described_port(const engine::ExportedPort& exported) {
        // A connection of the port with itself is resolved to a component like any other connection.
        ApplicationProfile one = composite_;
        one.connections = {{exported.location, exported.type, exported.port, exported.port, ""}};
        const auto flat = engine::flatten_composites(one, options_.plugin_dirs);
        const engine::ConnectionProfile& resolved = flat.connections.front();
        if (!resolved.error.empty()) throw engine::SetupError(exported.location, resolved.error);
        // The resolved connection's source contains the component and the port.
        for (const auto& entry : flat.subcomponents)
            if (entry.name == resolved.source.component)
                for (json port : ports_of(entry))
                    if (port["name"] == resolved.source.port && port["kind"] == port_kind(exported.type)) {
                        port["name"] = exported.name;
                        port["of"] = resolved.source.text();
                        return port;
                    }
        throw engine::SetupError(exported.location, "component '" + resolved.source.component + "' has no " +
                                                        port_kind(exported.type) + " port '" +
                                                        resolved.source.port + "'");
    }

    // Describes each component once, even if it exports several ports.
    const json& ports_of(const engine::Subcomponent& entry) {
        const auto [known, is_new] = ports_.try_emplace(entry.name);
        if (is_new) {
            const auto profile = engine::read_component_profile(entry.file);
            auto dirs = options_.plugin_dirs;
            dirs.insert(dirs.begin(), composite_.location.file.parent_path());
            const auto library = engine::find_component_library(profile, dirs);
            engine::require_opros_component(library);
            known->second = describe_in_child(library, entry.file, options_)["ports"];
        }
        return known->second;
    }

    const ApplicationProfile& composite_;
    const InspectOptions& options_;
    std::map<std::string, json> ports_;
};

json describe_composite(const ApplicationProfile& profile, const InspectOptions& options) {
    return {{"kind", "composite"},
            {"name", profile.name},
            {"components", describe_components(profile)},
            {"ports", ExportedPorts(profile, options).all()}};
}

// Signatures are written as in C++: "bool (double t)".
json describe_service_types(const std::filesystem::path& file) {
    json types = json::array();
    for (const auto& type : engine::read_service_type_profile(file)) {
        json methods = json::array();
        for (const auto& method : type.methods) {
            // Names of parameters are optional in the profile.
            std::string parameters;
            for (const auto& each : method.parameters)
                parameters +=
                    (parameters.empty() ? "" : ", ") + each.type + (each.name.empty() ? "" : " " + each.name);
            methods.push_back({{"name", method.name},
                               {"signature", method.return_type + " (" + parameters + ")"},
                               {"call", method.call_type}});
        }
        types.push_back({{"name", type.name}, {"methods", methods}});
    }
    return {{"kind", "service type"}, {"types", types}};
}

// Fields are in the profile's order, with their default values as text.
json describe_data_types(const std::filesystem::path& file) {
    json types = json::array();
    for (const auto& type : engine::read_data_type_profile(file)) {
        json fields = json::array();
        for (const auto& field : type.fields)
            fields.push_back({{"name", field.name}, {"type", field.type}, {"default", field.default_value}});
        types.push_back({{"name", type.name}, {"fields", fields}});
    }
    return {{"kind", "data type"}, {"types", types}};
}

// Returns a member as one line of text, because profiles may contain any character.
std::string string_at(const json& object, const char* key) {
    return replace_control_characters(object.at(key).get<std::string>());
}

// A composite exports ports; an application has connections.
std::string format_assembly(const json& info) {
    Table components({"component", "profile"});
    for (const json& each : info["components"])
        components.add_row({string_at(each, "name"), string_at(each, "profile")});
    std::string text = "\n" + components.text();
    if (info.contains("ports")) return text + "\n" + format_ports(info["ports"]);
    Table connections({"connection", "from", "to"});
    for (const json& each : info["connections"])
        connections.add_row({string_at(each, "kind"), string_at(each, "from"), string_at(each, "to")});
    return text + "\n" + (connections.empty() ? "no connections\n" : connections.text());
}

// Service types with methods and data types with fields are tables of three columns.
std::string format_types(const json& info) {
    std::string text;
    for (const json& type : info["types"]) {
        const bool is_service = type.contains("methods");
        Table table({is_service ? "method" : "field", is_service ? "signature" : "type",
                     is_service ? "call" : "default"});
        for (const json& each : type[is_service ? "methods" : "fields"])
            table.add_row({string_at(each, "name"), string_at(each, is_service ? "signature" : "type"),
                           string_at(each, is_service ? "call" : "default")});
        text += "\n" + string_at(type, "name") + "\n" + table.text();
    }
    return text;
}

} // namespace

json describe_profile(engine::ProfileKind kind, const InspectOptions& options) {
    json info;
    if (kind == engine::ProfileKind::application)
        info = describe_application(engine::read_application_profile(options.file));
    else if (kind == engine::ProfileKind::composite)
        info = describe_composite(engine::read_composite_profile(options.file), options);
    else if (kind == engine::ProfileKind::service_type)
        info = describe_service_types(options.file);
    else
        info = describe_data_types(options.file);
    info["profile"] = std::filesystem::absolute(options.file).lexically_normal().string();
    return info;
}

std::string format_profile(const json& info) {
    const std::string kind = string_at(info, "kind");
    // Only applications and composites have a name; the profiles of types do not.
    const bool is_assembly = info.contains("components");
    return fmt::format("{:<11}  {}\nprofile      {}\n", kind, is_assembly ? string_at(info, "name") : "",
                       string_at(info, "profile")) +
           (is_assembly ? format_assembly(info) : format_types(info));
}

} // namespace tandem::command
