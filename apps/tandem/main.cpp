// SPDX-License-Identifier: Apache-2.0
// tandem: one command with sub-commands. See --help.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/examples.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"
#include "host/log/output_failures.hpp"
#include "host/options/usage_error.hpp"
#include "shm/segment/dead_segments.hpp"

#include <fmt/format.h>
#include <tandem_version.hpp>

#include <csignal>
#include <cstdio>
#include <exception>

// NOLINTNEXTLINE(bugprone-exception-escape): outside the try blocks, only a wrongly declared option throws
int main(int argc, char** argv) {
    tandem::log::hold_standard_streams();
    // The program starts itself as a child process to load component libraries safely. In that child, this
    // call does not return.
    auto probe_tasks = tandem::command::opros_probe_tasks();
    probe_tasks.merge(tandem::command::rtc_probe_tasks());
    tandem::plugin::serve_probe(argc, argv, probe_tasks);
    CLI::App app{"Inspects, builds and controls components and links of Tandem hosts on this machine.",
                 "tandem"};
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("tandem ") + tandem::version);
    app.footer(
        "Run tandem COMMAND --help for the help of a command. On a new machine, run tandem doctor first.\n"
        "The documentation is in share/doc/tandem beside the folder bin of this program; docs/README.md "
        "lists its pages.");
    tandem::command::Action selected;
    tandem::command::add_doctor_command(app, selected);
    tandem::command::add_opros_commands(app, selected);
    tandem::command::add_rtm_commands(app, selected);
    tandem::command::add_idl_commands(app, selected);
    tandem::command::add_link_commands(app, selected);
    tandem::command::add_run_command(app, selected);
    tandem::command::add_system_commands(app, selected);
    tandem::command::add_shm_commands(app, selected);
    tandem::command::add_observe_commands(app, selected);
    tandem::command::add_top_commands(app, selected);
    tandem::command::add_record_commands(app, selected);
    tandem::command::add_replay_command(app, selected);
    tandem::command::add_bag_commands(app, selected);
    tandem::command::add_monitor_command(app, selected);
    tandem::command::add_completion_command(app, selected);
    tandem::command::add_examples(app);
    // Exceeding the file size limit makes write() fail instead of ending the process.
    std::signal(SIGXFSZ, SIG_IGN);
    if (const auto result = tandem::options::parse(app, argc, argv)) return *result;
    int exit_code = 1;
    try {
        exit_code = selected();
    } catch (const std::exception& error) {
        // Messages may quote file names and component texts: control characters must not reach the terminal.
        tandem::command::print_note("tandem: {}\n",
                                    tandem::command::replace_control_characters(error.what()));
    }
    // shm and doctor remove segments only on request, and monitor is read-only.
    if (!app.got_subcommand("shm") && !app.got_subcommand("doctor") && !app.got_subcommand("monitor"))
        tandem::shm::remove_dead_segments();
    return exit_code;
}
