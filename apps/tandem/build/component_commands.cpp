// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/component_commands.hpp"

#include <memory>

namespace tandem::command {

CLI::App* add_command(CLI::App& parent, const char* name, const char* brief, const char* details) {
    CLI::App* command = parent.add_subcommand(name, brief);
    command->footer(details);
    return command;
}

// CLI11 fills the options after this function has returned: the callback shares them.
void add_new_command(CLI::App& parent, const char* brief, const char* details, CreateComponent create,
                     Action& selected) {
    struct Options {
        std::string name;
        std::filesystem::path parent = ".";
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(parent, "new", brief, details);
    command->add_option("NAME", options->name, "name of the component, valid as the name of a C++ class")
        ->required();
    command->add_option("--in", options->parent, "parent folder (.)")->type_name("DIR");
    command->callback([=, &selected] { selected = [=] { return create(options->name, options->parent); }; });
}

} // namespace tandem::command
