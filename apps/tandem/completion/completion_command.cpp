// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/commands.hpp"
#include "apps/tandem/completion/bash_completion.hpp"
#include "apps/tandem/output/print.hpp"

#include <memory>

namespace tandem::command {

void add_completion_command(CLI::App& tandem, Action& selected) {
    CLI::App* command = tandem.add_subcommand(
        "completion", "Prints the script by which a shell completes commands and options of tandem");
    command->footer(
        "Installed for bash as share/bash-completion/completions/tandem. In a shell that does not read\n"
        "that folder:  source <(tandem completion bash)");
    auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "the shell")->required()->check(CLI::IsMember({"bash"}));
    // The tree is complete only when all commands have been added: it is walked when the command runs.
    command->callback([&tandem, &selected, shell] {
        selected = [&tandem] {
            print_text(bash_completion_script(tandem));
            return 0;
        };
    });
}

} // namespace tandem::command
