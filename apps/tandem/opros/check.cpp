// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/peer_ports.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/shared_ports/link_ports.hpp"
#include "apps/tandem/shared_ports/running_host.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/node/node_part.hpp"
#include "host/opros/engine/profile/component_profile.hpp"
#include "host/opros/engine/profile/start_order.hpp"
#include "host/opros/engine/profile/type_profile.hpp"

#include <algorithm>
#include <boost/algorithm/string/erase.hpp>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

/// Reads the referenced file, relative to the profile's folder, and adds the error if it cannot be parsed.
void check(const fs::path& folder, const std::string& reference,
           const std::function<void(const fs::path&)>& read, std::vector<std::string>& errors) {
    std::error_code ignored;
    if (reference.empty() || !fs::is_regular_file(folder / reference, ignored)) return;
    try {
        read(folder / reference);
    } catch (const engine::SetupError& error) {
        errors.emplace_back(error.what());
    }
}

/// Returns the errors in the service and data type profiles that a component's profile refers to, one line per file. A
/// missing file is not an error: it is not needed at run time, and components are often shipped without it.
std::vector<std::string> find_type_profile_errors(const engine::ComponentProfile& profile) {
    const fs::path folder = profile.location.file.parent_path();
    // Sets, because several ports usually refer to one file, whose error is reported once.
    std::set<std::string> services(profile.service_types.begin(), profile.service_types.end());
    for (const auto& port : profile.service_ports) services.insert(port.reference);
    const std::set<std::string> data(profile.data_types.begin(), profile.data_types.end());
    std::vector<std::string> errors;
    for (const std::string& each : services)
        check(
            folder, each, [](const fs::path& file) { engine::read_service_type_profile(file); }, errors);
    for (const std::string& each : data)
        check(
            folder, each, [](const fs::path& file) { engine::read_data_type_profile(file); }, errors);
    return errors;
}

/// Removes std::, const, reference and spaces, so that both sides are comparable. ReturnType is another name of int.
std::string normalized(std::string type) {
    for (const char* part : {"std::", "const ", " const", "&", " "}) boost::erase_all(type, part);
    return type == "ReturnType" ? "int" : type;
}

/// Returns for example `double(string,int)`.
std::string signature_of(const engine::MethodProfile& method) {
    std::string text = normalized(method.return_type) + "(";
    for (std::size_t i = 0; i < method.parameters.size(); ++i)
        text += (i ? "," : "") + normalized(method.parameters[i].type);
    return text + ")";
}

/// Compares the methods of a component's port with its service profile.
void compare(const std::string& port, const nlohmann::json& methods,
             const engine::ServiceTypeProfile& service, std::vector<std::string>& lines) {
    std::map<std::string, std::string> code;
    for (const auto& method : methods) code[method["name"]] = method["signature"];
    for (const auto& method : service.methods) {
        const auto found = code.find(method.name);
        if (found == code.end()) {
            lines.push_back(fmt::format("{}: service port '{}' of the component has no method '{}'",
                                        method.location.text(), port, method.name));
            continue;
        }
        if (normalized(found->second) != signature_of(method))
            lines.push_back(fmt::format("{}: method '{}' is {} here, {} in the component's port '{}'",
                                        method.location.text(), method.name, signature_of(method),
                                        normalized(found->second), port));
        code.erase(found);
    }
    for (const auto& [name, signature] : code)
        lines.push_back(fmt::format("{}: method '{}' of the component's port '{}' is not in this profile",
                                    service.location.text(), name, port));
}

/// Compares the methods of a component's service ports (from describe_component()) with the referenced service
/// profiles. Returns a line for each method that exists on one side only, or has another result or arguments. Only the
/// code matters at run time. Reports a type's other name (a typedef) as a difference.
std::vector<std::string> find_service_differences(const engine::ComponentProfile& profile,
                                                  const nlohmann::json& ports) {
    std::vector<std::string> lines;
    for (const auto& port : profile.service_ports) {
        const fs::path file = profile.location.file.parent_path() / port.reference;
        std::error_code ignored;
        if (port.reference.empty() || !fs::is_regular_file(file, ignored)) continue;
        const auto described = std::find_if(ports.begin(), ports.end(), [&](const auto& each) {
            return each["name"] == port.name && each.contains("methods");
        });
        if (described == ports.end()) continue; // find_port_mismatches() reports it
        try {
            const auto services = engine::read_service_type_profile(file);
            const auto named = std::find_if(services.begin(), services.end(),
                                            [&](const auto& each) { return each.name == port.type; });
            compare(port.name, (*described)["methods"], named == services.end() ? services.front() : *named,
                    lines);
        } catch (const engine::SetupError&) { // find_type_profile_errors() reports it
        }
    }
    return lines;
}

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
    std::erase_if(type, [](unsigned char c) { return std::isspace(c); });
    boost::erase_all(type, "std::");
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

/// Compares a profile's ports with those of the component (`ports` of describe_component()). Returns a line with the
/// profile's file and line for each port that is missing or has another kind, direction or type. `initialized`:
/// onInitialize has run, so that all ports exist.
std::vector<std::string> find_port_mismatches(const engine::ComponentProfile& profile, const json& ports,
                                              bool initialized) {
    std::vector<std::string> errors = profile.port_errors;
    for (const ProfilePort& profile_port : profile_ports(profile))
        if (const std::string text = describe_mismatch(profile_port, ports, initialized); !text.empty())
            errors.push_back(profile_port.location.text() + ": " + text);
    return errors;
}

using engine::ApplicationProfile;

/// Collects the findings, one line each.
class Findings {
  public:
    /// Runs a step. Returns false and adds the message to the errors if the step throws.
    bool run_step(const std::function<void()>& step) {
        try {
            step();
            return true;
        } catch (const std::runtime_error& error) {
            lines.emplace_back(error.what());
            return false;
        }
    }
    void add(const std::vector<std::string>& errors) {
        lines.insert(lines.end(), errors.begin(), errors.end());
    }
    void add_notes(const std::vector<std::string>& lines) {
        notes.insert(notes.end(), lines.begin(), lines.end());
    }
    std::vector<std::string> lines; ///< errors: with them, the application does not do what the profiles say
    std::vector<std::string> notes; ///< findings that do not keep the application from running
    /// Lines about components whose ports are currently unknown.
    std::vector<std::string> unknown;
    std::set<std::string> unknown_components;
    /// The ports of each AdaptorComp, from link::encode_as_text().
    std::map<std::string, std::string> port_tables;
};

/// Throws engine::SetupError if the RTM host's configuration cannot be applied.
std::optional<LinkPorts> find_shared_ports(const engine::Subcomponent& entry, const std::string& link,
                                           LinkPortFinder& finder) {
    try {
        return finder.find(link);
    } catch (const plugin::Error& error) { // its message contains the file
        throw engine::SetupError(entry.location, "component '" + entry.name + "': the ports of link '" +
                                                     link + "' are unknown: " + error.what());
    }
}

/// Adds the mirrored ports of an AdaptorComp to its own ports. Returns false and adds a line if they are currently
/// unknown.
bool find_mirrors(const engine::Subcomponent& entry, const std::string& link, LinkPortFinder& finder,
                  nlohmann::json& ports, Findings& findings) {
    const auto shared = find_shared_ports(entry, link, finder);
    if (!shared) {
        const std::string where =
            finder.conf().empty()
                ? "; start the RTM host and check again, or give its configuration with --rtc-conf FILE"
                : ", and " + finder.conf().string() + " has no InterceptorComp with this link";
        findings.unknown.push_back(
            fmt::format("{}: connections of component '{}' cannot be checked: its ports are those of the RTC "
                        "on link '{}', which no running RTM host shares{}",
                        entry.location.text(), entry.name, link, where));
        findings.unknown_components.insert(entry.name);
        return false;
    }
    findings.port_tables[entry.name] = link::encode_as_text(shared->table);
    for (auto& port : describe_mirrors(shared->table)) ports.push_back(std::move(port));
    return true;
}

/// Adds the differences between a component and its profile. Returns false if its ports are currently unknown. Throws
/// if there is no component to connect.
bool check_component(const ApplicationProfile& application, const engine::Subcomponent& entry,
                     const InspectOptions& options, LinkPortFinder& finder, Findings& findings) {
    // The application's folder comes first, as in opros_host.
    auto dirs = options.plugin_dirs;
    dirs.insert(dirs.begin(), application.location.file.parent_path());
    // flatten_composites() has already found the profiles of a composite's components.
    const auto file = entry.file.empty()
                          ? engine::find_component_profile(application, entry, options.plugin_dirs)
                          : entry.file;
    const auto profile = engine::read_component_profile(file);
    const auto library = engine::find_component_library(profile, dirs);
    try {
        engine::require_opros_component(library);
        const bool mirrors = is_adaptor(library);
        // Without its peer, AdaptorComp cannot initialize and has only a few of its ports.
        auto inspection = options;
        inspection.initialize = options.initialize && !mirrors;
        const auto description = describe_in_child(library, file, inspection);
        findings.add(engine::check_properties(profile, entry, dirs));
        // Skips properties that the application sets; the profile need not contain them. Other missing properties may
        // be optional.
        for (const auto& absent : description["absent_properties"]) {
            const std::string name = absent["name"];
            const auto is_it = [&](const auto& property) { return property.first == name; };
            if (std::any_of(entry.properties.begin(), entry.properties.end(), is_it)) continue;
            (absent["misspelt"] ? findings.lines : findings.notes).push_back(absent["line"]);
        }
        auto ports = description["ports"];
        if (mirrors && !find_mirrors(entry, adaptor_link(entry, profile), finder, ports, findings))
            return false;
        // The engine takes ports and methods from the code, not from these profiles.
        findings.add_notes(find_port_mismatches(profile, ports, options.initialize || mirrors));
        findings.add_notes(find_type_profile_errors(profile));
        findings.add_notes(find_service_differences(profile, ports));
        return true;
        // The error does not name the profile, so the location of <library_name> is prepended.
    } catch (const plugin::Error& error) {
        throw engine::SetupError(profile.library_location, error.what());
    }
}

/// Returns for example "1 error" or "2 errors".
std::string count_text(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// Ends the text with a summary, even if there are no errors.
void print_report(const ApplicationReport& report, bool as_json) {
    if (as_json) {
        print_json({{"application", report.name},
                    {"components", report.components},
                    {"connections", report.connections},
                    {"errors", report.errors},
                    {"notes", report.notes},
                    {"not_checked", report.unknown}});
        return;
    }
    for (const std::string& line : report.errors) print_text(line + "\n");
    for (const std::string& line : report.notes) print_text("note: " + line + "\n");
    for (const std::string& line : report.unknown) print_text(line + "\n");
    const std::string fit = count_text(report.components, "component") + " and " +
                            count_text(report.connections - report.not_checked, "connection") + " fit";
    const std::string unknown =
        report.unknown.empty() ? "" : "; " + count_text(report.not_checked, "connection") + " not checked";
    const std::string notes = report.notes.empty() ? "" : "; " + count_text(report.notes.size(), "note");
    print_text(report.name + ": " +
               (report.errors.empty() ? fit : count_text(report.errors.size(), "error")) + unknown + notes +
               "\n");
}

} // namespace

// Continues after an error, so that one run reports all errors.
ApplicationReport check_application(const InspectOptions& options) {
    // A missing profile is not an error here, because check_component() reports each one below.
    const auto application = engine::local_application(engine::read_application_profile(options.file),
                                                       options.plugin_dirs, options.node);
    Findings errors;
    errors.add(application.structure_errors);
    for (const auto& connection : application.connections)
        if (!connection.error.empty())
            errors.lines.push_back(connection.location.text() + ": " + connection.error);
    LinkPortFinder finder(options.rtc_conf.empty() ? peer_rtc_conf(options.file) : options.rtc_conf,
                          {{}, options.timeout_s});
    std::vector<std::string> excluded;
    for (const auto& entry : application.subcomponents) {
        bool is_known = false;
        errors.run_step([&] { is_known = check_component(application, entry, options, finder, errors); });
        if (!is_known) excluded.push_back(entry.name);
    }
    // Excludes unusable components, so that the other connections are still checked.
    errors.run_step([&] { engine::start_order(application); });
    errors.run_step([&] { errors.add(check_connections_in_child(excluded, errors.port_tables, options)); });
    const auto is_unknown = [&](const std::string& component) {
        return errors.unknown_components.count(component) != 0;
    };
    const auto not_checked =
        std::count_if(application.connections.begin(), application.connections.end(), [&](const auto& each) {
            return is_unknown(each.source.component) || is_unknown(each.target.component);
        });
    return {application.name,
            application.subcomponents.size(),
            application.connections.size(),
            static_cast<std::size_t>(not_checked),
            std::move(errors.lines),
            std::move(errors.notes),
            std::move(errors.unknown)};
}

int opros_check(const InspectOptions& options) {
    const ApplicationReport report = check_application(options);
    print_report(report, options.json);
    return report.errors.empty() ? 0 : 1;
}

} // namespace tandem::command
