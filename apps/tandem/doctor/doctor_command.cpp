// SPDX-License-Identifier: Apache-2.0
// `tandem doctor`: checks this machine, and optionally an application, and prints the results as a table or
// as JSON.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/doctor/check_result.hpp"
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/doctor/exposure.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/run/run_folder.hpp"
#include "apps/tandem/shared_ports/link_ports.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/rtm/runtime/configuration/manager_settings.hpp"
#include "host/text/join.hpp"
#include "shm/inspect/observer.hpp"
#include "shm/os/error.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <stdexcept>
#include <vector>

namespace tandem::command {
namespace {

struct FolderCheckOptions {
    std::filesystem::path folder; ///< as for tandem run: opros/ with an application, rtm/rtc.conf
    std::vector<std::filesystem::path> plugin_dirs;
    double timeout_s = 10; ///< time limit for the components' code, which runs in child processes
};

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
    for (const auto& dir : plugin::default_plugin_dirs("opros")) inspect.plugin_dirs.push_back(dir);
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
        const auto rtcs = probe_rtc_instances(folder.rtc_conf, {options.plugin_dirs, options.timeout_s});
        const std::string names = text::join(rtcs, ", ", [](const auto& rtc) { return rtc.name; });
        found.push_back(doctor::ok("RTCs", names.empty() ? "none" : replace_control_characters(names)));
    } catch (const std::runtime_error& error) {
        found.push_back(failure("RTCs", "cannot be created", error.what()));
    }
}

/// Returns the settings that decide who reaches an rtm_host, in the spelling that it reads.
doctor::RtmSettings settings_of_exposure(const coil::Properties& properties) {
    doctor::RtmSettings settings;
    for (const char* key :
         {"corba.endpoint", "corba.endpoints", "corba.master_manager", "corba.nameservers",
          "corba.permitted_users", "corba.ssl.certificate_authority_file", "corba.ssl.key_file",
          "manager.is_master", "manager.modules.remote_load", "manager.remote_shutdown", "naming.enable"})
        if (std::string value = properties.getProperty(key); !value.empty()) {
            RTC::check_and_normalize_value(key, value);
            settings[key] = value;
        }
    return settings;
}

doctor::RtmSettings read_conf(const std::filesystem::path& conf) {
    coil::Properties properties;
    RTC::read_conf_file(conf, properties);
    return settings_of_exposure(properties);
}

doctor::RtmSettings read_settings_of_running(const RTC::ManagerStart& start) {
    coil::Properties properties;
    RTC::SettingOrigins ignored;
    RTC::read_manager_settings(start, properties, ignored);
    return settings_of_exposure(properties);
}

/// Says what the set-up opens to other users and machines.
void check_exposure(const RunFolder& folder, std::vector<CheckResult>& found) {
    const doctor::RtmSettings settings = read_conf(folder.rtc_conf);
    for (auto& result : doctor::check_rtm_host("rtc.conf", settings, doctor::configured_endpoints(settings)))
        found.push_back(std::move(result));
}

/// A running process in the link blocks the new host from joining.
void check_link(const std::string& link, std::vector<CheckResult>& found) {
    try {
        const auto observation = shm::observe(link);
        for (const auto side : {shm::Side::first, shm::Side::second}) {
            if (!observation) continue;
            const auto& there = observation->segment.side(side);
            if (!there.held && there.state != shm::PeerState::alive && there.state != shm::PeerState::stopped)
                continue;
            const std::string process =
                there.pid_elsewhere != 0 ? "the process with " + format_pid(there.pid, there.pid_elsewhere)
                : there.pid != 0         ? fmt::format("process {}", there.pid)
                                 : "a process of another build of Tandem"; // its segment cannot be read
            found.push_back(
                doctor::error("link " + link, process + " uses it",
                              fmt::format("only one host of each model can use a link: end {}, or give this "
                                          "application's link another name",
                                          process)));
            return;
        }
        found.push_back(doctor::ok("link " + link, "free"));
    } catch (const shm::Error& error) {
        found.push_back(failure("link", "not usable", error.what()));
    }
}

/// Checks the folder, the OPRoS components, all connections and the RTCs, and whether other hosts use the links.
/// Reports problems as results, not as exceptions.
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
    check_exposure(folder, found);
    check_rtcs(folder, options, found);
    try {
        LinkPortFinder finder(folder.rtc_conf, {options.plugin_dirs, options.timeout_s});
        for (const auto& [link, rtc] : finder.configured_links()) check_link(link, found);
    } catch (const std::runtime_error&) { // check_rtcs() has reported the error
    }
    return found;
}

using doctor::CheckStatus;

const char* status_text(CheckStatus status) {
    return status == CheckStatus::ok ? "ok" : status == CheckStatus::warning ? "warning" : "error";
}

// The advice follows the table because its lines are too long for a column.
std::string format_results(const std::vector<doctor::CheckResult>& results) {
    Table table({"status", "check", "found"});
    for (const auto& result : results) table.add_row({status_text(result.status), result.name, result.value});
    std::string advice;
    for (const auto& result : results)
        if (result.status != CheckStatus::ok) advice += fmt::format("  {}: {}\n", result.name, result.advice);
    return table.text() + (advice.empty() ? "" : "\nWhat to do:\n" + advice);
}

// Only warnings and errors have "advice".
nlohmann::json results_json(const std::vector<doctor::CheckResult>& results) {
    auto checks = nlohmann::json::array();
    for (const auto& result : results) {
        checks.push_back(
            {{"name", result.name}, {"status", status_text(result.status)}, {"value", result.value}});
        if (!result.advice.empty()) checks.back()["advice"] = result.advice;
    }
    return {{"checks", checks}};
}

int run_doctor(const FolderCheckOptions& application, bool json) {
    const doctor::Machine machine = doctor::probe_this_machine();
    auto results = doctor::run_checks(machine);
    results.push_back(doctor::check_runtime_folder(machine));
    results.push_back(doctor::check_segment_modes(machine));
    for (auto& result : doctor::check_running_programs(machine, read_settings_of_running))
        results.push_back(std::move(result));
    if (!application.folder.empty())
        for (auto& result : check_run_folder(application)) results.push_back(std::move(result));
    if (json)
        print_json(results_json(results));
    else
        print_text(format_results(results));
    // Warnings do not fail, so that a set-up script can run the doctor as its last step.
    const bool any_error = std::any_of(results.begin(), results.end(), [](const auto& result) {
        return result.status == CheckStatus::error;
    });
    return any_error ? 1 : 0;
}

} // namespace

void add_doctor_command(CLI::App& tandem, Action& selected) {
    CLI::App* command = tandem.add_subcommand(
        "doctor", "Checks this machine, and with DIR an application, and says how to fix what is wrong");
    command->footer(
        R"(  ok       as it should be
  warning  works, but slower or less predictably, or fails in some cases, or is open to others
  error    Tandem does not run, or fails after some time
With DIR, a folder for tandem run, also checks whether its hosts can run: profiles, libraries,
properties and connections of the OPRoS components, RTCs, and links that other hosts use. Components
are created in child processes. To see each port with its peer, run tandem link check DIR.
Also shows what the running hosts, managers and monitors of this user, their segments, and the
rtc.conf in DIR open to other users and other machines.
Run tandem doctor as the user who runs the hosts: it tests permissions in a child process. Changes
nothing. Exit code 1 if there is an error, otherwise 0.)");
    auto json = std::make_shared<bool>(false);
    auto application = std::make_shared<FolderCheckOptions>();
    command->add_option("DIR", application->folder, "folder with opros/ and rtm/");
    add_plugin_path(command, application->plugin_dirs);
    add_seconds(command, "--timeout", application->timeout_s, "time limit for the components' code (10)");
    command->add_flag("--json", *json, "print JSON instead of text");
    command->callback([=, &selected] { selected = [=] { return run_doctor(*application, *json); }; });
}

} // namespace tandem::command
