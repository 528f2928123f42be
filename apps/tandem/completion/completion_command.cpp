// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/commands.hpp"
#include "apps/tandem/completion/bash_completion.hpp"
#include "apps/tandem/output/print.hpp"

#include <memory>

namespace tandem::command {

void add_completion_command(CLI::App& tandem, Action& selected) {
    CLI::App* command = tandem.add_subcommand(
        "completion", "Prints a script that lets a shell complete tandem's commands and options");
    command->footer("Tandem installs the script for bash as share/bash-completion/completions/tandem. In a "
                    "shell that does\n"
                    "not read that folder, run:  source <(tandem completion bash)");
    auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "the shell")->required()->check(CLI::IsMember({"bash"}));
    // Walks the tree when the command runs, because only then all commands have been added.
    command->callback([&tandem, &selected, shell] {
        selected = [&tandem] {
            print_text(bash_completion_script(tandem));
            return 0;
        };
    });
}

} // namespace tandem::command
