// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/component_commands.hpp"

#include <memory>

namespace tandem::command {

void add_plugin_path(CLI::App* command, std::vector<std::filesystem::path>& folders) {
    command->add_option("--plugin-path", folders, "folder with component libraries (repeatable)")
        ->type_name("DIR")
        ->allow_extra_args(false);
}

void add_seconds(CLI::App* command, const char* name, double& seconds, const char* description) {
    command->add_option(name, seconds, description)->type_name("SECONDS")->check(CLI::Range(0.1, 3600.));
}

void add_inspection_options(CLI::App* command, bool& initialize, double& timeout_s, bool& json) {
    command->add_flag(
        "--initialize", initialize,
        "run onInitialize() of OPRoS components in a child process, for ports that are created there");
    add_seconds(command, "--timeout", timeout_s, "time limit for the components' code (10)");
    command->add_flag("--json", json, "print JSON instead of text");
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
