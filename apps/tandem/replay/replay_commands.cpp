// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem replay`.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/replay/commands.hpp"

#include <memory>

namespace tandem::command {

void add_replay_command(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<ReplayOptions>();
    CLI::App* command = add_command(
        tandem, "replay", "Plays a recording back into a system, in the place of one of its hosts",
        "Joins the recorded links as the host that is absent, with its ports, and sends what it has\n"
        "sent; calls are answered as they were, and its calls are made again. To the host that stays\n"
        "this is a host as any other: when the replay ends it is gone, and what must stop then stops.\n"
        "With --lockstep the hosts of an application that stay are started in DIR (tandem run DIR,\n"
        "wheelchair --keep DIR) and get their cycles one after the other: in the recorded order, if\n"
        "the recording is one of --lockstep --record, otherwise by their periods. Recorded with\n"
        "--lockstep --record, the same bytes come out.\n"
        "--check compares each answer with the recorded one, and names the first difference by tick\n"
        "and member.\n"
        "Exit code 1 if an answer differs, a recorded type has changed, or nobody is there to replay\n"
        "to.");
    command->add_option("FILE", options->file, "recording of tandem record")->required();
    command
        ->add_option("--in-place-of", options->in_place_of,
                     "opros_host, rtm_host, or a component that a link shares (the host that is absent)")
        ->type_name("WHO");
    command->add_option("--link", options->link, "the name that the recording's one link has now")
        ->type_name("LINK");
    auto* rate =
        command
            ->add_option("--rate", options->rate, "recorded seconds in a second; 0: as fast as it goes (1)")
            ->type_name("FACTOR")
            ->check(CLI::Range(0.0, 1000.0));
    command
        ->add_flag("--step", options->step,
                   "wait for Enter before each message, in lock-step before each tick")
        ->excludes(rate);
    auto* lockstep =
        command->add_option("--lockstep", options->lockstep, "folder of the application, as of tandem run")
            ->type_name("DIR");
    add_plugin_path(command, options->plugin_dirs);
    command->get_option("--plugin-path")->needs(lockstep);
    auto* check = command->add_flag("--check", options->check, "compare the answers with the recorded ones");
    command->add_flag("--times", options->times, "the times of sending must be the same, too")->needs(check);
    add_seconds(command, "--wait", options->wait_s, "time limit for the hosts that stay (60)");
    command->callback([=, &selected] { selected = [options] { return replay(*options); }; });
}

} // namespace tandem::command
