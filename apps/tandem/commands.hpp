// SPDX-License-Identifier: Apache-2.0
// The groups of sub-commands of the program `tandem`. Each adds itself to the command line and, when it was
// chosen, says what is to be run; main.cpp runs it and turns exceptions into one line and exit code 1.
#pragma once
#include <CLI/CLI.hpp>

#include <functional>

namespace tandem::command {

using Action = std::function<int()>; ///< Returns the exit code.

void add_opros_commands(CLI::App& tandem, Action& selected);
void add_rtm_commands(CLI::App& tandem, Action& selected);
void add_shm_commands(CLI::App& tandem, Action& selected);

} // namespace tandem::command
