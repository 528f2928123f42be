// SPDX-License-Identifier: Apache-2.0
// `tandem doctor`: checks this machine, and optionally an application, and prints the results as a table or
// as JSON.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/link/folder_check.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tandem::command {
namespace {

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
    auto results = doctor::run_checks(doctor::probe_this_machine());
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
        "  ok       as it should be\n"
        "  warning  works, but slower or less predictably, or fails in some cases\n"
        "  error    Tandem does not run, or fails after some time\n"
        "With DIR, a folder for tandem run, also checks whether its hosts can run: profiles, libraries,\n"
        "properties and connections of the OPRoS components, RTCs, and links that other hosts use. "
        "Components\n"
        "are created in child processes. To see each port with its peer, run tandem link check DIR.\n"
        "Run tandem doctor as the user who runs the hosts: it tests permissions in a child process. Changes\n"
        "nothing. Exit code 1 if there is an error, otherwise 0.");
    auto json = std::make_shared<bool>(false);
    auto application = std::make_shared<FolderCheckOptions>();
    command->add_option("DIR", application->folder, "folder with opros/ and rtm/");
    add_plugin_path(command, application->plugin_dirs);
    add_seconds(command, "--timeout", application->timeout_s, "time limit for the components' code (10)");
    command->add_flag("--json", *json, "print JSON instead of text");
    command->callback([=, &selected] { selected = [=] { return run_doctor(*application, *json); }; });
}

} // namespace tandem::command
