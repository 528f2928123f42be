// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/opros/engine/profile/type_profile.hpp"
#include "host/plugin/find_library.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace tandem::command {
namespace {

using nlohmann::json;

/// Returns a table of the ports from describe_component(), with the methods of services; "no ports" if there are none.
std::string format_ports(const json& ports) {
    Table table({"kind", "direction", "name", "type"});
    for (const json& port : ports) {
        // A service has methods instead of a data type. Each method is a line below the port.
        const bool service = port["kind"] == "service";
        const std::string type = service                  ? ""
                                 : port["type"].is_null() ? "any"
                                                          : port["type"].get<std::string>();
        table.add_row({port["kind"], port["direction"], port["name"], type});
        if (!service || !port.contains("methods")) continue;
        for (const json& method : port["methods"])
            table.add_row({"", "", "",
                           method["name"].get<std::string>() + ": " + method["signature"].get<std::string>() +
                               (method["call"] == "nonblocking" ? ", nonblocking" : "")});
    }
    return table.empty() ? "no ports\n" : table.text();
}

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

/// Returns the profile of an application, composite, service type or data type as JSON. "kind" is its kind.
/// Applications and composites have "name" and "components", and "connections" or "ports"; types have "types" with
/// "methods" or "fields". The types of a composite's ports come from its components' code, which runs in a child
/// process. Throws engine::SetupError.
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

/// Formats the result of describe_profile() as text.
std::string format_profile(const json& info) {
    const std::string kind = string_at(info, "kind");
    // Only applications and composites have a name; the profiles of types do not.
    const bool is_assembly = info.contains("components");
    return fmt::format("{:<11}  {}\nprofile      {}\n", kind, is_assembly ? string_at(info, "name") : "",
                       string_at(info, "profile")) +
           (is_assembly ? format_assembly(info) : format_types(info));
}

/// Returns the profile's word: "periodic", "passive", ...
std::string to_string(engine::ExecutionType execution) {
    switch (execution) {
    case engine::ExecutionType::periodic:
        return "periodic";
    case engine::ExecutionType::periodic_shared:
        return "periodic-shared";
    case engine::ExecutionType::aperiodic:
        return "aperiodic";
    case engine::ExecutionType::aperiodic_loop:
        return "aperiodic-loop";
    case engine::ExecutionType::passive:
        return "passive";
    }
    return "unknown";
}

/// Returns for example "periodic, every 10 ms, priority 7". Omits zeros and defaults.
/// Times are in milliseconds, as in the profile.
std::string format_executor(const engine::ComponentProfile& profile) {
    std::string text = to_string(profile.execution_type);
    const auto ms = [](std::chrono::nanoseconds time) {
        return fmt::format("{} ms", static_cast<double>(time.count()) / 1e6);
    };
    // Omits zero and the default policy, which are the values of missing elements.
    if (profile.period.count() != 0) text += ", every " + ms(profile.period);
    if (profile.phase.count() != 0) text += ", phase " + ms(profile.phase);
    if (profile.priority != 0) text += fmt::format(", priority {}", profile.priority);
    if (profile.scheduling_policy != engine::SchedulingPolicy::other)
        text += profile.scheduling_policy == engine::SchedulingPolicy::fifo ? " (SCHED_FIFO)" : " (SCHED_RR)";
    return text;
}

using nlohmann::json;
namespace fs = std::filesystem;

/// The library of a component and its profile, if any.
struct InspectedComponent {
    fs::path library;
    std::optional<engine::ComponentProfile> profile;
    std::string unreadable; ///< without a profile: error of a file beside the library that may be the profile
};

// Returns whether the profile names this library, in any spelling that the host accepts.
bool refers_to(const engine::ComponentProfile& profile, const fs::path& library) {
    const auto candidates = plugin::library_file_names(profile.library_name);
    return std::find(candidates.begin(), candidates.end(), library.filename().string()) != candidates.end();
}

// Adds the component profile in the library's folder that names the library, if any.
InspectedComponent find_profile_beside(const fs::path& library) {
    InspectedComponent found{library, std::nullopt, ""};
    for (const auto& file : list_entries(fs::absolute(library).parent_path(), ".xml")) {
        try {
            if (engine::find_profile_kind(file) != engine::ProfileKind::component) continue;
            auto profile = engine::read_component_profile(file);
            if (refers_to(profile, library)) return {library, std::move(profile), ""};
        } catch (const engine::SetupError& error) {
            if (found.unreadable.empty()) found.unreadable = error.what();
        }
    }
    return found;
}

// FILE is a profile, which names its library, or a library with an optional profile beside it. In the latter case, an
// error in the profile is only a note.
InspectedComponent find_component(const InspectOptions& options) {
    if (options.file.empty())
        throw std::runtime_error("FILE is empty: expected a component library or profile");
    // Only profiles have the extension .xml.
    if (!is_xml(options.file)) return find_profile_beside(options.file);
    auto profile = engine::read_component_profile(options.file);
    return {engine::find_component_library(profile, options.plugin_dirs), std::move(profile), ""};
}

// Describes the execution settings of the profile. A library does not contain them.
json describe_executor(const engine::ComponentProfile& profile) {
    return {{"type", to_string(profile.execution_type)},
            {"period_ms", static_cast<double>(profile.period.count()) / 1e6},
            {"phase_ms", static_cast<double>(profile.phase.count()) / 1e6},
            {"priority", profile.priority}};
}

// Checks the library's file first, which detects wrong kinds without running code, and then loads it in a child
// process.
json inspect(const InspectedComponent& found, const InspectOptions& options) {
    engine::require_opros_component(found.library);
    json info =
        describe_in_child(found.library, found.profile ? found.profile->location.file : fs::path(), options);
    // Absolute paths, because the JSON may be read in another folder. Values from a missing profile are null.
    info["library"] = fs::absolute(found.library).lexically_normal().string();
    info["name"] = found.profile ? found.profile->name : found.library.stem().string();
    info["profile"] =
        found.profile ? json(fs::absolute(found.profile->location.file).lexically_normal().string()) : json();
    info["executor"] = found.profile ? describe_executor(*found.profile) : json();
    info["notes"] = found.profile ? engine::check_properties(*found.profile, {}, options.plugin_dirs)
                                  : std::vector<std::string>();
    if (!found.unreadable.empty()) info["notes"].push_back("the profile may be " + found.unreadable);
    for (const json& absent : info["absent_properties"]) info["notes"].push_back(absent["line"]);
    info.erase("absent_properties");
    return info;
}

// Converts the JSON, so that both formats have the same contents.
std::string format_component(const json& info, const InspectedComponent& found,
                             const InspectOptions& options) {
    std::string text =
        fmt::format("component  {}\nlibrary    {}, {}\n", info["name"].get<std::string>(),
                    info["library"].get<std::string>(),
                    info.contains("version") ? info["version"].get<std::string>() : "no version");
    text += "profile    " +
            (found.profile              ? info["profile"].get<std::string>()
             : found.unreadable.empty() ? "none beside the library"
                                        : "none readable beside the library") +
            "\n";
    if (found.profile) text += "executor   " + format_executor(*found.profile) + "\n";
    text += "\n" + format_ports(info["ports"]);
    // A component without ports probably creates them in onInitialize.
    if (info["ports"].empty() && !options.initialize)
        text +=
            "to see ports created by onInitialize(), use --initialize, which runs it in a child process\n";
    if (!info["properties"].empty()) {
        Table table({"property", "value"});
        for (const auto& [name, value] : info["properties"].items())
            table.add_row({replace_control_characters(name), replace_control_characters(value)});
        text += "\n" + table.text();
    }
    if (!info["notes"].empty()) text += "\n";
    for (const json& line : info["notes"]) text += replace_control_characters(line.get<std::string>()) + "\n";
    return text;
}

} // namespace

// Only profiles of components have a library to load.
int opros_info(const InspectOptions& options) {
    if (is_xml(options.file))
        if (const auto kind = engine::read_profile_kind(options.file);
            kind != engine::ProfileKind::component) {
            const json info = describe_profile(kind, options);
            options.json ? print_json(info) : print_text(format_profile(info));
            return 0;
        }
    const InspectedComponent found = find_component(options);
    const json info = inspect(found, options);
    if (options.json)
        print_json(info);
    else
        print_text(format_component(info, found, options));
    return 0;
}

} // namespace tandem::command
