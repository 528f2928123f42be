// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/component_commands.hpp"
#include "host/options/number_check.hpp"

#include <cstdlib>
#include <memory>

namespace tandem::command {

void add_plugin_path(CLI::App* command, std::vector<std::filesystem::path>& folders) {
    command->add_option("--plugin-path", folders, "folder with component libraries (repeatable)")
        ->type_name("DIR")
        ->allow_extra_args(false);
}

void add_seconds(CLI::App* command, const char* name, double& seconds, const char* description) {
    command->add_option(name, seconds, description)
        ->type_name("SECONDS")
        ->check(options::number_between(0.1, 3600.));
}

void add_inspection_options(CLI::App* command, bool& initialize, double& timeout_s, bool& json) {
    command->add_flag(
        "--initialize", initialize,
        "run onInitialize() of OPRoS components in a child process, to see the ports that it creates");
    add_seconds(command, "--timeout", timeout_s, "time limit for the components' code (10)");
    command->add_flag("--json", json, "print JSON instead of text");
}

void add_build_options(CLI::App* command, PluginBuildOptions& options, const char* output_help) {
    const auto repeated = [&](const char* flag, std::vector<std::string>& values, const char* what) {
        return command->add_option(flag, values, what)->allow_extra_args(false);
    };
    command->add_option("DIR", options.folder, "folder of the component")->required();
    repeated("-I,--include", options.include_dirs, "folder with headers of other components (repeatable)")
        ->type_name("DIR");
    repeated("-D,--define", options.definitions, "preprocessor definition (repeatable)");
    repeated("-l,--library", options.libraries, "library to link: a name or a file (repeatable)");
    repeated("--pkg-config", options.pkg_config, "pkg-config module to use, for example opencv4 (repeatable)")
        ->type_name("MODULE");
    repeated("--source", options.sources.sources,
             "source file or pattern to build instead of those found (repeatable)")
        ->type_name("FILE");
    repeated("--exclude", options.sources.excluded, "source file or pattern to leave out (repeatable)")
        ->type_name("FILE");
    command
        ->add_option("--standard", options.standard,
                     "C++ standard (that of the folder's CMake project, at least 14)")
        ->check(CLI::IsMember({11, 14, 17, 20}));
    const CLI::Validator types =
        CLI::IsMember({"Debug", "Release", "RelWithDebInfo", "MinSizeRel", "None"}, CLI::ignore_case);
    CLI::Option* const type = command
                                  ->add_option("--build-type", options.build_type,
                                               "CMake build type, for example Debug for gdb (RelWithDebInfo)")
                                  ->type_name("TYPE")
                                  ->envname("CMAKE_BUILD_TYPE")
                                  ->check(types);
    // CLI11 2.4 ignores a value of the environment that the check refuses.
    command->parse_complete_callback([type, types] {
        const char* const value = std::getenv("CMAKE_BUILD_TYPE");
        if (value == nullptr || *value == '\0' || type->count() > 0) return;
        throw CLI::ValidationError("CMAKE_BUILD_TYPE", types(std::string(value)));
    });
    command
        ->add_option("--timeout", options.timeout_s,
                     "time limit for configuring and for compiling, each (600)")
        ->type_name("SECONDS")
        ->check(options::number_between(0.1, 86400.));
    command->add_option("--output", options.output, output_help)->type_name("DIR");
    command
        ->add_option("--build-dir", options.build,
                     "build folder to keep for the next build (a temporary folder)")
        ->type_name("DIR");
}

// CLI11 fills in the options after this function has returned, so the callback shares ownership of them.
void add_new_command(CLI::App& parent, const char* brief, const char* details, CreateComponent create,
                     Action& selected) {
    struct Options {
        std::string name;
        std::filesystem::path parent = ".";
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = add_command(parent, "new", brief, details);
    command->add_option("NAME", options->name, "name of the component, a valid C++ class name")->required();
    command->add_option("--in", options->parent, "parent folder (.)")->type_name("DIR");
    command->callback([=, &selected] { selected = [=] { return create(options->name, options->parent); }; });
}

} // namespace tandem::command
