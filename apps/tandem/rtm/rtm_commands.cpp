// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem rtm`.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/import/commands.hpp"
#include "apps/tandem/rtm/commands.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <memory>

namespace tandem::command {
namespace {

void add_rtm_build(CLI::App& rtm, Action& selected) {
    auto options = std::make_shared<RtmBuildOptions>();
    CLI::App* command = add_command(
        rtm, "build", "Builds an RT-Component from nothing but its folder",
        "Takes the sources in DIR and DIR/src, or what its CMakeLists.txt or makefile lists, without those\n"
        "that have a main(), the IDL files in DIR and DIR/idl, those above DIR that a source needs, and the\n"
        "headers there and in DIR/include. The function NAMEInit(RTC::Manager*) gives the plugin its name;\n"
        "of several modules each is built. It is put into DIR. Nothing else is changed. Exit code 1 if one\n"
        "cannot be built.");
    add_build_options(command, *options, "folder for the plugin instead of DIR");
    command->add_option("--name", options->name, "module to build, when DIR has several (all of them)");
    command->callback([=, &selected] { selected = [options] { return rtm_build(*options); }; });
}

} // namespace

void add_rtm_commands(CLI::App& tandem, Action& selected) {
    CLI::App* rtm = tandem.add_subcommand(
        "rtm", "RT-Components: create and build them, inspect and control those that run");
    rtm->require_subcommand(1);
    add_new_command(
        *rtm, "Writes an RT-Component that builds and runs without changes",
        "Creates the folder NAME with NAME.h, NAME.cpp, rtc.conf, and a CMakeLists.txt that builds it with\n"
        "find_package(OpenRTM), here and elsewhere. Exit code 1 if the folder exists.",
        rtm_new, selected);
    add_rtm_build(*rtm, selected);
    add_rtm_import(*rtm, selected);
    add_running_commands(*rtm, selected);
}

} // namespace tandem::command
