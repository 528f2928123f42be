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
        link, "profile", "Writes what joins an OPRoS component and an RTC, for tandem run",
        "A and B are the folders of two built components, one of each model, or the OPRoS component's\n"
        "profile and the RTC's module. Ports are connected that have the same name, or else the only\n"
        "type that fits; each other port is told with the reason. Writes DIR/opros and DIR/rtm.\n"
        "Exit code 1, and no DIR, if no port can be connected.");
    command->add_option("A", options->first, "folder of a component")->required();
    command->add_option("B", options->second, "folder of a component of the other model")->required();
    command
        ->add_option("-o,--output,--out", options->out,
                     "folder to write (./OPROS-RTC, named after the components)")
        ->type_name("DIR");
    command->add_option("--profile", options->profile, "component profile, when the OPRoS folder has several")
        ->type_name("FILE");
    command->add_option("--type", options->type, "component type, when the RTC's module has several")
        ->type_name("NAME");
    command->add_option("--link", options->link, "name of the link (as the folder)")->type_name("NAME");
    command
        ->add_option("--property", options->properties,
                     "property of AdaptorComp, for instance names.PORT=print=echo or convert.PORT=widen; may "
                     "be repeated")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    add_inspection_options(command, options->initialize, options->timeout_s, options->json);
    command->callback([=, &selected] { selected = [options] { return link_profile(*options); }; });
}

void add_link_check(CLI::App& link, Action& selected) {
    auto options = std::make_shared<LinkCheckOptions>();
    CLI::App* command = add_command(
        link, "check", "Prints which ports of both sides are joined, and why the others are not",
        "DIR is the folder of tandem run: opros/ with an application, rtm/rtc.conf. The hosts may run or "
        "not.\n"
        "Signatures are those of docs/wire_format.md; of services, operations as each model writes them.\n"
        "Exit code 1 if a connection of the application cannot be made.");
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
