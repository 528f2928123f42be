// SPDX-License-Identifier: Apache-2.0
// tandem: one command with sub-commands. See --help.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/output/format.hpp"

#include <fmt/format.h>
#include <tandem_version.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    tandem::plugin::serve_probe(argc, argv, tandem::command::opros_probe_tasks());
    CLI::App tandem{"Looks at, and looks after, a system of Tandem hosts on this machine.", "tandem"};
    tandem.require_subcommand(1);
    tandem.set_version_flag("--version", std::string("tandem ") + tandem::version);
    tandem.footer("tandem COMMAND --help says more about a command.");
    tandem::command::Action selected;
    tandem::command::add_opros_commands(tandem, selected);
    tandem::command::add_rtm_commands(tandem, selected);
    tandem::command::add_shm_commands(tandem, selected);
    try {
        tandem.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        return tandem.exit(end);
    }
    try {
        return selected();
    } catch (const std::exception& failure) {
        fmt::print(stderr, "tandem: {}\n", tandem::command::replace_control_characters(failure.what()));
        return 1;
    }
}
