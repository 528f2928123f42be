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
                     "folder for tandem run, which may have the other side already (./FOLDER-tandem)")
        ->type_name("DIR");
    command->add_option("--link", options.link, link)->type_name("NAME");
    command->add_flag("--json", options.json, "print JSON instead of text");
}

} // namespace

void add_opros_import(CLI::App& opros, Action& selected) {
    auto options = std::make_shared<OprosImportOptions>();
    CLI::App* command = add_command(
        opros, "import", "Writes what tandem run needs from an installation of the OPRoS engine",
        "Reads system.xml, if there is one, the application profile and the components' folders, and writes\n"
        "DIR/opros: the profile and those folders without libraries that were built for the engine. The\n"
        "installation is not changed. Prints what is to be done before tandem run, and each thing that will\n"
        "differ: where, what, and what happens here instead.");
    add_import_options(command, *options, "ENGINE_DIR", "add an AdaptorComp with this link");
    command->add_option("--app", options->application, "application, by name or file, when there are several")
        ->type_name("NAME");
    command->callback([=, &selected] { selected = [options] { return opros_import(*options); }; });
}

void add_rtm_import(CLI::App& rtm, Action& selected) {
    auto options = std::make_shared<RtmImportOptions>();
    CLI::App* command = add_command(
        rtm, "import", "Writes what tandem run needs from an rtc.conf and an RTSystem profile",
        "Reads rtc.conf (or conf/rtc_cpp.conf) of an installation of OpenRTM-aist, the files of settings "
        "that\n"
        "it names, and the profile that RTSystemEditor has written, if there is one, and writes DIR/rtm. "
        "The\n"
        "installation is not changed. Prints what is to be done before tandem run, and each thing that will\n"
        "differ: where, what, and what happens here instead.");
    add_import_options(command, *options, "RTCD_DIR",
                       "add an InterceptorComp with this link, which shares all RTCs");
    command->add_option("--rtc-conf", options->conf, "rtc.conf to read (the one in RTCD_DIR)")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command
        ->add_option("--system", options->system,
                     "RTSystem profile to read (the one in RTCD_DIR or RTCD_DIR/system)")
        ->type_name("FILE")
        ->check(CLI::ExistingFile);
    command->add_flag("--activate", options->activate,
                      "activate the profile's components when the host starts, as a person does in "
                      "RTSystemEditor");
    command->callback([=, &selected] { selected = [options] { return rtm_import(*options); }; });
}

} // namespace tandem::command
