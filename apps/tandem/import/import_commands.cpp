// SPDX-License-Identifier: Apache-2.0
// The command lines of `tandem opros import` and `tandem rtm import`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/import/commands.hpp"

#include <memory>

namespace tandem::command {
namespace {

void add_import_options(CLI::App* command, ImportOptions& options, const char* folder, const char* link) {
    command->add_option(folder, options.folder, "folder of the installation")->required();
    command
        ->add_option("-o,--output", options.output,
                     "folder for tandem run; it may already contain the other host's part (./FOLDER-tandem)")
        ->type_name("DIR");
    command->add_option("--link", options.link, link)->type_name("NAME");
    command->add_flag("--json", options.json, "print JSON instead of text");
}

} // namespace

void add_opros_import(CLI::App& opros, Action& selected) {
    auto options = std::make_shared<OprosImportOptions>();
    CLI::App* command = add_command(
        opros, "import", "Imports an installation of the OPRoS engine into a folder for tandem run",
        R"(Reads system.xml if it exists, the application profile and the components' folders. Writes to DIR/opros
the profile and those folders, without the libraries built for the engine. Does not change the
installation. Prints what to do before tandem run, and each difference in behaviour: where it is,
what the engine did, and what Tandem does instead.)");
    add_import_options(command, *options, "ENGINE_DIR", "add an AdaptorComp with this link");
    command
        ->add_option("--app", options->application, "name or file of the application, if there are several")
        ->type_name("NAME");
    command->callback([=, &selected] { selected = [options] { return opros_import(*options); }; });
}

void add_rtm_import(CLI::App& rtm, Action& selected) {
    auto options = std::make_shared<RtmImportOptions>();
    CLI::App* command =
        add_command(rtm, "import", "Imports an rtc.conf and an RTSystem profile into a folder for tandem run",
                    R"(Reads rtc.conf (or rtcd.conf, conf/rtc_cpp.conf, conf/rtc.conf) of an installation of
OpenRTM-aist, the configuration files that it names, and the profile written by
RTSystemEditor if there is one. Writes DIR/rtm. Does not change the installation.
Prints what to do before tandem run, and each difference in behaviour: where it is,
what OpenRTM-aist did, and what Tandem does instead.)");
    add_import_options(command, *options, "RTCD_DIR",
                       "add an InterceptorComp that shares all RTCs over this link");
    command->add_option("--rtc-conf", options->conf, "rtc.conf to read (the one in RTCD_DIR)")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--system", options->system,
                     "RTSystem profile to read (the one in RTCD_DIR or RTCD_DIR/system)")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command->add_flag(
        "--activate", options->activate,
        "activate the profile's components when the host starts, instead of by hand in RTSystemEditor");
    command->callback([=, &selected] { selected = [options] { return rtm_import(*options); }; });
}

} // namespace tandem::command
