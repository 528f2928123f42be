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

/// What has been found so far, one line each.
class Findings {
  public:
    /// Runs a step. True if it did not throw; otherwise what it threw has been added to the list.
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
    std::vector<std::string> lines; ///< the errors
    std::vector<std::string> notes; ///< what need not be wrong
    /// Lines about components whose ports are not known now.
    std::vector<std::string> unknown;
    std::set<std::string> unknown_components;
    /// The ports that each AdaptorComp will have, as link::encode_as_text().
    std::map<std::string, std::string> port_tables;
};

/// Throws engine::SetupError if the RTM host's configuration cannot be carried out.
std::optional<LinkPorts> find_shared_ports(const engine::Subcomponent& entry, const std::string& link,
                                           LinkPortFinder& finder) {
    try {
        return finder.find(link);
    } catch (const plugin::Error& error) { // names the file
        throw engine::SetupError(entry.location, "component '" + entry.name + "': the ports of link '" +
                                                     link + "' are unknown: " + error.what());
    }
}

/// Adds the ports of an AdaptorComp to those that it has without its peer. False, with a line that says so, if they
/// are not known now.
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

/// Adds where a component does not fit its profile. False if it cannot be connected, because its ports are not known
/// now. Throws if there is no component that could be connected.
bool check_component(const ApplicationProfile& application, const engine::Subcomponent& entry,
                     const InspectOptions& options, LinkPortFinder& finder, Findings& findings) {
    // The application's folder comes first, as in opros_host.
    auto dirs = options.plugin_dirs;
    dirs.insert(dirs.begin(), application.location.file.parent_path());
    // flatten_composites() has already found the profiles of what it has taken out of a composite.
    const auto file = entry.file.empty()
                          ? engine::find_component_profile(application, entry, options.plugin_dirs)
                          : entry.file;
    const auto profile = engine::read_component_profile(file);
    const auto library = engine::find_component_library(profile, dirs);
    try {
        engine::require_opros_component(library);
        const bool mirrors = is_adaptor(library);
        // Without its peer an AdaptorComp does not initialize, and then has but few of its ports.
        auto inspection = options;
        inspection.initialize = options.initialize && !mirrors;
        const auto description = describe_in_child(library, file, inspection);
        findings.add(engine::check_properties(profile, entry.properties, dirs));
        // What the application sets is not in the profile. A component may do without other properties.
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
        // A library's own errors do not say which profile names it: the line of <library_name> is put before them.
    } catch (const plugin::Error& error) {
        throw engine::SetupError(profile.library_location, error.what());
    }
}

/// "1 error", "2 errors"
std::string count_text(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// The last line of the text is a summary, also of an application without errors.
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

// Goes on after an error, so that one run reports all of them.
ApplicationReport check_application(const InspectOptions& options) {
    auto application = engine::read_application_profile(options.file);
    Findings errors;
    // A missing profile is not an error here: check_component() reports each one below.
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
    // Components that cannot be run are left out, so that the connections of the others are still checked.
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
