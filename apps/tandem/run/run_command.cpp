// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem run`.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/run/commands.hpp"
#include "host/options/number_check.hpp"

#include <memory>

namespace tandem::command {

void add_run_command(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command = add_command(
        tandem, "run", "Runs the two hosts of an application until Ctrl-C",
        R"(Starts opros_host with the application profile in DIR/opros, and rtm_host with DIR/rtm/rtc.conf. Each
runs in that folder. Prints the output of both hosts with the host's name before each line. When one
host ends, ends the other. If output cannot be written, for example on a full disk, the hosts continue,
and a line says how many lines are missing.
Exit code 0 if all hosts ended normally, 1 if one failed or was killed and was not restarted.)");
    command->add_option("DIR", options->folder, "folder with opros/ and rtm/; one of them may be missing")
        ->required();
    command
        ->add_option("--restart", options->restart,
                     "restart each host that dies after it was ready, up to N times (0)")
        ->type_name("N")
        ->check(CLI::Range(0, 1000000));
    add_plugin_path(command, options->plugin_dirs);
    add_seconds(command, "--wait", options->wait_s, "time limit for the hosts to become ready (60)");
    add_seconds(command, "--grace", options->grace_s,
                "time limit for the hosts to end, before they are killed (20)");
    auto* lockstep = command->add_flag("--lockstep", options->lockstep,
                                       "run the cycles of all components in lock-step: one after the other, "
                                       "by their periods, as fast as possible");
    command
        ->add_option("--duration", options->duration_s,
                     "end the lock-step after this simulated time (until Ctrl-C)")
        ->type_name("SECONDS")
        ->check(options::number_between(0.001, 1e9))
        ->needs(lockstep);
    command->add_option("--record", options->record, "record the lock-step to this file, for tandem replay")
        ->type_name("FILE")
        ->needs(lockstep);
    lockstep->excludes(command->get_option("--restart"));
    command
        ->add_option("--node", options->node,
                     "run only the part of this <node_id> of an application for several machines")
        ->type_name("ID");
    command->add_flag("--strict", options->strict, "end if an OPRoS component or a connection fails");
    command
        ->add_option("--host-option", options->host_arguments,
                     "option to pass to both hosts, for example --host-option=--lock-memory (repeatable)")
        ->type_name("OPTION")
        ->allow_extra_args(false);
    command->callback([=, &selected] { selected = [options] { return run_hosts(*options); }; });
}

} // namespace tandem::command
