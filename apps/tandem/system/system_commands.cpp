// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem system`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/system/commands.hpp"

#include <memory>

namespace tandem::command {
namespace {

void add_list(CLI::App& system, Action& selected) {
    struct Options {
        std::filesystem::path folder = ".";
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(system, "list", "Lists the systems and the built components in a folder",
                                    "Runs no code of the components.");
    command->add_option("DIR", options->folder, "folder that contains their folders (the current folder)");
    command->add_flag("--json", options->json, "print JSON instead of text");
    command->callback(
        [=, &selected] { selected = [options] { return system_list(options->folder, options->json); }; });
}

void add_new(CLI::App& system, Action& selected) {
    auto options = std::make_shared<NewSystemOptions>();
    CLI::App* command = add_command(
        system, "new", "Writes a folder for tandem run with components of both models, without connections",
        R"(A COMPONENT is the folder of a built component of either model, or its profile or module. Name it
several times for several instances. Each OPRoS component is also shown as an RTC: tandem rtm
connect and the page of tandem monitor --control connect any two ports while the system runs, and
tandem system save keeps the connections.)");
    command->add_option("DIR", options->folder, "folder to write; its name is that of the link")->required();
    command->add_option("COMPONENT", options->components, "components")->required();
    command->add_option("--timeout", options->timeout_s, "time limit for the components' code (10)")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.1, 3600.0));
    command->callback([=, &selected] { selected = [options] { return system_new(*options); }; });
}

void add_save(CLI::App& system, Action& selected) {
    auto options = std::make_shared<SaveSystemOptions>();
    CLI::App* command = add_command(
        system, "save", "Saves a running system as a folder for tandem run",
        R"(Copies the configuration from which the hosts run. Writes the current connections, active RTCs and
configuration sets of the RTM host, and the properties of the OPRoS components. Connections of the
OPRoS application stay as they are, because they cannot change while it runs. A line names what
cannot be saved.)");
    command->add_option("DIR", options->folder, "folder to write")->required();
    command
        ->add_option("--host", options->hosts,
                     "process id of a host to save, one of each model (this user's only ones; repeatable)")
        ->type_name("PID")
        ->allow_extra_args(false);
    command->add_flag(
        "--replace", options->replace,
        "DIR is the folder from which the hosts run: change its files, and keep the previous ones "
        "as FILE~");
    command->callback([=, &selected] { selected = [options] { return system_save(*options); }; });
}

} // namespace

void add_system_commands(CLI::App& tandem, Action& selected) {
    CLI::App* system = tandem.add_subcommand("system", "Creates, lists and saves systems for tandem run");
    system->require_subcommand(1);
    add_list(*system, selected);
    add_new(*system, selected);
    add_save(*system, selected);
}

} // namespace tandem::command
