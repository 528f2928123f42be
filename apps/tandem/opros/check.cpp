// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/peer_ports.hpp"
#include "apps/tandem/opros/port_mismatches.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/opros/service_differences.hpp"
#include "apps/tandem/opros/type_profile_errors.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/shared_ports/link_ports.hpp"
#include "apps/tandem/shared_ports/running_host.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/start_order.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <set>

namespace tandem::command {
namespace {

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
    std::vector<std::string> lines; ///< errors
    std::vector<std::string> notes; ///< findings that may be intended
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
        findings.add(engine::check_properties(profile, entry.properties, dirs));
        // Skips properties that the application sets; the profile need not contain them. Other missing properties may
        // be optional.
        for (const auto& absent : description["absent_properties"]) {
            const auto is_it = [&](const auto& property) { return property.first == absent["name"]; };
            if (std::any_of(entry.properties.begin(), entry.properties.end(), is_it)) continue;
            (absent["misspelt"] ? findings.lines : findings.notes).push_back(absent["line"]);
        }
        auto ports = description["ports"];
        if (mirrors && !find_mirrors(entry, adaptor_link(entry, profile), finder, ports, findings))
            return false;
        findings.add(find_port_mismatches(profile, ports, options.initialize || mirrors));
        findings.add(find_type_profile_errors(profile));
        for (auto& line : find_service_differences(profile, ports)) findings.notes.push_back(std::move(line));
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

// Ends the text with a summary, also if there are no errors.
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
    for (const auto* lines : {&report.errors, &report.notes, &report.unknown})
        for (const std::string& line : *lines) print_text(line + "\n");
    const std::string fit = count_text(report.components, "component") + " and " +
                            count_text(report.connections - report.not_checked, "connection") + " fit";
    const std::string unknown =
        report.unknown.empty() ? "" : "; " + count_text(report.not_checked, "connection") + " not checked";
    print_text(report.name + ": " +
               (report.errors.empty() ? fit : count_text(report.errors.size(), "error")) + unknown + "\n");
}

} // namespace

// Continues after an error, so that one run reports all errors.
ApplicationReport check_application(const InspectOptions& options) {
    auto application = engine::read_application_profile(options.file);
    Findings errors;
    // A missing profile is not an error here, because check_component() reports each one below.
    if (engine::has_composites(application, options.plugin_dirs))
        application = engine::flatten_composites(application, options.plugin_dirs);
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
