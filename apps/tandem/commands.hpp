// SPDX-License-Identifier: Apache-2.0
// The groups of sub-commands of the program `tandem`. Each function adds its group to the command line. The
// sub-command that the user chose stores its action in `selected`. main.cpp runs the action after parsing and
// turns an exception into one line on standard error and exit code 1.
#pragma once
#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace tandem::command {

using Action = std::function<int()>; ///< Returns the program's exit code.

/// Adds a sub-command. `brief`: its line in the parent's help; `details`: the text below its own options.
inline CLI::App* add_command(CLI::App& parent, const char* name, const char* brief,
                             const std::string& details) {
    CLI::App* command = parent.add_subcommand(name, brief);
    command->footer(details);
    return command;
}

// `tandem` and `selected` must outlive parsing: the callbacks of the sub-commands keep references to them.
void add_opros_commands(CLI::App& tandem, Action& selected);
void add_rtm_commands(CLI::App& tandem, Action& selected);
void add_idl_commands(CLI::App& tandem, Action& selected);
void add_link_commands(CLI::App& tandem, Action& selected);
void add_run_command(CLI::App& tandem, Action& selected);
void add_system_commands(CLI::App& tandem, Action& selected);
void add_shm_commands(CLI::App& tandem, Action& selected);
void add_observe_commands(CLI::App& tandem, Action& selected);
void add_top_commands(CLI::App& tandem, Action& selected);
void add_record_commands(CLI::App& tandem, Action& selected);
void add_replay_command(CLI::App& tandem, Action& selected);
void add_bag_commands(CLI::App& tandem, Action& selected);
void add_monitor_command(CLI::App& tandem, Action& selected);
void add_doctor_command(CLI::App& tandem, Action& selected);
void add_completion_command(CLI::App& tandem, Action& selected);

} // namespace tandem::command
