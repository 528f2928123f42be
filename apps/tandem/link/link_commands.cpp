// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem link`.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/link/commands.hpp"

#include <memory>

namespace tandem::command {
namespace {

void add_profile(CLI::App& link, Action& selected) {
    auto options = std::make_shared<LinkProfileOptions>();
    CLI::App* command = add_command(
        link, "profile", "Writes an application for tandem run that joins an OPRoS component and an RTC",
        R"(A and B are the folders of two built components, one of each model. Instead of a folder, you can
give the OPRoS component's profile or the RTC's module. Connects ports that have the same name, or
the only pair of ports whose types match. Prints each port left over with the reason. Writes
DIR/opros and DIR/rtm. Exit code 1, without writing DIR, if no port can be connected, unless
--property share=... shows a component as an RTC.)");
    command->add_option("A", options->first, "folder of a component")->required();
    command->add_option("B", options->second, "folder of a component of the other model")->required();
    command
        ->add_option("-o,--output,--out", options->out,
                     "folder to write (./OPROS-RTC, with the names of the components)")
        ->type_name("DIR");
    command->add_option("--profile", options->profile, "component profile, if the OPRoS folder has several")
        ->type_name("FILE");
    command->add_option("--type", options->type, "component type, if the RTC's module has several")
        ->type_name("NAME");
    command->add_option("--link", options->link, "name of the link (the names of both components)")
        ->type_name("NAME");
    command
        ->add_option(
            "--property", options->properties,
            "property of AdaptorComp, for example names.PORT=print=echo or convert.PORT=widen (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    add_inspection_options(command, options->initialize, options->timeout_s, options->json);
    command->callback([=, &selected] { selected = [options] { return link_profile(*options); }; });
}

void add_link_check(CLI::App& link, Action& selected) {
    auto options = std::make_shared<LinkCheckOptions>();
    CLI::App* command = add_command(
        link, "check", "Prints which ports of the two hosts are joined, and why the others are not",
        R"(DIR is a folder for tandem run, with an application in opros/ and with rtm/rtc.conf. The hosts need not
be running. Type signatures are those of share/doc/tandem/docs/wire_format.md. Operations of services are
printed in the notation of their model. Exit code 1 if a connection of the application cannot be made, or if
a component cannot be inspected.)");
    command->add_option("DIR", options->folder, "folder with opros/ and rtm/")->required();
    add_plugin_path(command, options->plugin_dirs);
    add_inspection_options(command, options->initialize, options->timeout_s, options->json);
    command->callback([=, &selected] { selected = [options] { return link_check(*options); }; });
}

} // namespace

void add_link_commands(CLI::App& tandem, Action& selected) {
    CLI::App* link = tandem.add_subcommand("link", "Joins OPRoS components and RTCs");
    link->require_subcommand(1);
    add_profile(*link, selected);
    add_link_check(*link, selected);
}

} // namespace tandem::command
