// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem rtm`.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/census/census_commands.hpp"
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
        rtm, "build", "Builds an RT-Component from the sources in its folder",
        R"(Builds the sources in DIR and DIR/src, or those that its CMakeLists.txt, makefile or Visual C++ project
lists, except files with a main(). Also uses the IDL files in DIR and DIR/idl, those in sub-folders, above
DIR, in the rest of the repository and in folders of -I that a source or another IDL file includes, and the
headers in these folders and in DIR/include.
The function NAMEInit(RTC::Manager*), or the implementation_id beside rtc_init(), gives the plugin its name.
If DIR has several modules, each is built. Writes the plugins to DIR and changes nothing else.
Exit code 1 if a build fails.)");
    add_build_options(command, *options, "folder for the plugin (DIR)");
    command->add_option("--name", options->name, "module to build, if DIR has several (all)");
    command->callback([=, &selected] { selected = [options] { return rtm_build(*options); }; });
}

} // namespace

void add_rtm_commands(CLI::App& tandem, Action& selected) {
    CLI::App* rtm = tandem.add_subcommand(
        "rtm", "Creates, builds and imports RT-Components; inspects and controls running ones");
    rtm->require_subcommand(1);
    add_new_command(*rtm, "Creates the sources of a new RT-Component, ready to build and run",
                    "Creates the folder NAME with NAME.h, NAME.cpp, rtc.conf and CMakeLists.txt. The "
                    "CMakeLists.txt uses\n"
                    "find_package(OpenRTM) and works with Tandem and with OpenRTM-aist. Exit code 1 if the "
                    "folder exists.",
                    rtm_new, selected);
    add_rtm_build(*rtm, selected);
    add_census_command(*rtm, rtm_census_model, "sources with a function NAMEInit(RTC::Manager*)", selected);
    add_rtm_import(*rtm, selected);
    add_running_commands(*rtm, selected);
}

} // namespace tandem::command
