// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem opros`.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/census/census_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/import/commands.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/running/running_commands.hpp"
#include "host/plugin/plugin_dirs.hpp"

#include <memory>

namespace tandem::command {
namespace {

// `what` describes FILE, the only difference between the two commands.
void add_inspect_options(CLI::App* command, InspectOptions& options, const char* what) {
    command->add_option("FILE", options.file, what)->required();
    add_plugin_path(command, options.plugin_dirs);
    add_inspection_options(command, options.initialize, options.timeout_s, options.json);
}

// Folders from the command line come first, as in opros_host.
void append_default_dirs(InspectOptions& options) {
    const auto dirs = plugin::default_plugin_dirs("opros");
    options.plugin_dirs.insert(options.plugin_dirs.end(), dirs.begin(), dirs.end());
}

void add_info_and_check(CLI::App& opros, Action& selected) {
    // Shared by info and check, because only one of them is parsed in a run.
    auto options = std::make_shared<InspectOptions>();
    CLI::App* info = add_command(
        opros, "info", "Shows a component: ports with their types, services, properties, executor",
        R"(FILE is a library, a profile, or the name of a running component (see tandem opros list), which is
shown with its state and connections. If there is a file of that name, write HOST/COMPONENT.
Creates the component in a child process and reports its crash or hang as an error. For a
composite, shows its components and the ports that it exports; for an application, its components
and connections; for a service type or data type, its methods or fields.
Exit code 1 if the component cannot be created, or if FILE is none of these.)");
    add_inspect_options(info, *options, "component library (X.so), profile (X.xml) or running component");
    info->callback([=, &selected] {
        selected = [options] {
            if (names_running_component(options->file))
                return opros_running_info({options->timeout_s, options->json}, options->file.string());
            append_default_dirs(*options);
            return opros_info(*options);
        };
    });
    CLI::App* check = add_command(
        opros, "check", "Checks an application: libraries, ports, types of connected ports",
        R"(Prints each error on one line: file, line, what is wrong, what was expected. Lines that begin
with 'note:' show differences that do not keep the application from running.
Exit code 1 if there is an error.)");
    add_inspect_options(check, *options, "application profile (XML)");
    check
        ->add_option("--rtc-conf", options->rtc_conf,
                     "rtc.conf of the RTM host behind an AdaptorComp, to know its ports while that host is "
                     "not running (../rtm/rtc.conf if FILE is in a folder named opros)")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    check
        ->add_option("--node", options->node,
                     "check only the part of this <node_id> of an application for several machines")
        ->type_name("ID");
    check->callback([=, &selected] {
        selected = [options] {
            append_default_dirs(*options);
            return opros_check(*options);
        };
    });
}

void add_opros_build(CLI::App& opros, Action& selected) {
    auto options = std::make_shared<OprosBuildOptions>();
    CLI::App* command = add_command(
        opros, "build", "Builds a component from the sources in its folder",
        R"(Builds the sources in DIR and DIR/src, or those that its CMakeLists.txt, makefile or Visual C++
project lists. If DIR has a CMake project, configures it, which executes its CMake code. The
component profile in DIR or DIR/profile gives the plugin its name; if there is none, the profile
in one of the two folders above that has the folder's name. Writes the plugin beside the profile
and changes nothing else. Exit code 1 if the build fails.)");
    add_build_options(command, *options,
                      "folder for the plugin and its profiles (the folder of the profile)");
    command
        ->add_option("--profile", options->profile,
                     "component profile, if DIR has several; relative to the current folder or to DIR")
        ->type_name("FILE");
    command->callback([=, &selected] { selected = [options] { return opros_build(*options); }; });
}

} // namespace

void add_opros_commands(CLI::App& tandem, Action& selected) {
    CLI::App* opros = tandem.add_subcommand(
        "opros", "Inspects, checks, creates, builds and imports OPRoS components; controls running ones");
    opros->require_subcommand(1);
    add_info_and_check(*opros, selected);
    add_new_command(
        *opros, "Creates the sources of a new component, ready to build and run",
        "Creates the folder NAME with NAME.h, NAME.cpp, the component profile NAME.xml, the application\n"
        "profile NAMEApp.xml, and CMakeLists.txt. Exit code 1 if the folder exists.",
        opros_new, selected);
    add_opros_build(*opros, selected);
    add_census_command(*opros, opros_census_model, "component profiles with sources beside them", selected);
    add_opros_import(*opros, selected);
    add_running_opros_commands(*opros, selected);
}

} // namespace tandem::command
