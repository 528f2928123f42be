// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/link/folder_check.hpp"

#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/run/run_folder.hpp"
#include "apps/tandem/shared_ports/link_ports.hpp"
#include "host/opros/engine/load/plugin_dirs.hpp"
#include "shm/inspect/observer.hpp"
#include "shm/os/error.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::command {
namespace {

using doctor::CheckResult;

/// Removes control characters, because lines may quote texts of components.
CheckResult failure(const char* name, const char* found, const std::string& line) {
    return doctor::error(name, found, replace_control_characters(line));
}

void check_opros(const RunFolder& folder, const FolderCheckOptions& options,
                 std::vector<CheckResult>& found) {
    constexpr const char* name = "OPRoS application";
    InspectOptions inspect;
    inspect.initialize = true; // as the host does
    inspect.file = folder.application;
    inspect.plugin_dirs = options.plugin_dirs;
    for (const auto& dir : engine::default_plugin_dirs()) inspect.plugin_dirs.push_back(dir);
    inspect.rtc_conf = folder.rtc_conf;
    inspect.timeout_s = options.timeout_s;
    try {
        const ApplicationReport report = check_application(inspect);
        for (const auto& line : report.errors) found.push_back(failure(name, "does not fit", line));
        // Without the other host's configuration the ports are unknown (a warning). With it, a missing link
        // is an error.
        for (const auto& line : report.unknown)
            if (folder.rtc_conf.empty())
                found.push_back(doctor::warning(name, "not checked", replace_control_characters(line)));
            else
                found.push_back(failure(name, "does not fit", line));
        if (report.errors.empty() && report.unknown.empty())
            found.push_back(doctor::ok(name, fmt::format("{} components and {} connections fit",
                                                         report.components, report.connections)));
    } catch (const std::runtime_error& error) {
        found.push_back(failure(name, "cannot be read", error.what()));
    }
}

void check_rtcs(const RunFolder& folder, const FolderCheckOptions& options, std::vector<CheckResult>& found) {
    try {
        std::string names;
        for (const auto& rtc : probe_rtc_instances(folder.rtc_conf, {options.plugin_dirs, options.timeout_s}))
            names += (names.empty() ? "" : ", ") + rtc.name;
        found.push_back(doctor::ok("RTCs", names.empty() ? "none" : replace_control_characters(names)));
    } catch (const std::runtime_error& error) {
        found.push_back(failure("RTCs", "cannot be created", error.what()));
    }
}

/// A running process in the link blocks the new host from joining.
void check_link(const std::string& link, std::vector<CheckResult>& found) {
    try {
        const auto observation = shm::observe(link);
        for (const auto side : {shm::Side::first, shm::Side::second}) {
            if (!observation) continue;
            const auto& there = observation->segment.side(side);
            if (there.state != shm::PeerState::alive && there.state != shm::PeerState::stopped) continue;
            found.push_back(
                doctor::error("link " + link, fmt::format("process {} uses it", there.pid),
                              fmt::format("only one host of each model can use a link: end process {}, or "
                                          "give this application's link another name",
                                          there.pid)));
            return;
        }
        found.push_back(doctor::ok("link " + link, "free"));
    } catch (const shm::Error& error) {
        found.push_back(failure("link", "not usable", error.what()));
    }
}

} // namespace

std::vector<CheckResult> check_run_folder(const FolderCheckOptions& options) {
    std::vector<CheckResult> found;
    RunFolder folder;
    try {
        folder = find_run_folder(options.folder);
    } catch (const std::runtime_error& error) {
        return {failure("application", "cannot be run", error.what())};
    }
    for (const auto& line : folder.conf_warnings)
        found.push_back(doctor::warning("rtc.conf", "has no effect", replace_control_characters(line)));
    if (!folder.application.empty()) check_opros(folder, options, found);
    if (folder.rtc_conf.empty()) return found;
    check_rtcs(folder, options, found);
    try {
        LinkPortFinder finder(folder.rtc_conf, {options.plugin_dirs, options.timeout_s});
        for (const auto& [link, rtc] : finder.configured_links()) check_link(link, found);
    } catch (const std::runtime_error&) { // check_rtcs() has reported the error
    }
    return found;
}

} // namespace tandem::command
