// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem replay`.
#include "apps/tandem/build/component_commands.hpp"
#include "apps/tandem/commands.hpp"
#include "apps/tandem/replay/commands.hpp"
#include "host/options/number_check.hpp"

#include <memory>

namespace tandem::command {

void add_replay_command(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<ReplayOptions>();
    CLI::App* command = add_command(
        tandem, "replay", "Replays a recording in place of one of the hosts of a system",
        R"(Joins the recorded links as the absent host, with that host's ports. Sends the messages that the
host sent, repeats its calls, and answers calls as recorded. When the replay ends, the other host
sees its peer disappear and reacts as to any lost host.
With --lockstep, also starts the other hosts from DIR (as made for tandem run DIR or by
wheelchair --keep DIR) and runs their cycles one after the other: in the recorded order if the
recording was made with --lockstep --record, otherwise by their periods. A recording made with
--lockstep --record reproduces the same bytes.
--check compares each answer with the recorded one and prints the first difference with its tick
and member.
Exit code 1 if an answer differs, --check has nothing to compare, a recorded type has changed, a
part of the recording cannot be read, or no host is running that receives the replay.)");
    command->add_option("FILE", options->file, "recording made by tandem record")->required();
    command
        ->add_option(
            "--in-place-of", options->in_place_of,
            "what to replace: opros_host, rtm_host, or a component that a link shares (the absent host; "
            "required with --lockstep)")
        ->type_name("WHO");
    command->add_option("--link", options->link, "current name of the link, if the recording has one link")
        ->type_name("LINK");
    auto* rate =
        command
            ->add_option("--rate", options->rate,
                         "speed relative to the recording, in lock-step that of the ticks; 0 replays as "
                         "fast as possible (1; with --lockstep 0)")
            ->type_name("FACTOR")
            ->check(options::number_between(0.0, 1000.0));
    command
        ->add_flag("--step", options->step,
                   "wait for Enter before each message; with --lockstep, before each tick")
        ->excludes(rate);
    auto* lockstep =
        command->add_option("--lockstep", options->lockstep, "folder of the application, as for tandem run")
            ->type_name("DIR");
    add_plugin_path(command, options->plugin_dirs);
    command->get_option("--plugin-path")->needs(lockstep);
    auto* check = command->add_flag("--check", options->check, "compare each answer with the recorded one");
    command->add_flag("--times", options->times, "also compare the times of sending")->needs(check);
    add_seconds(command, "--wait", options->wait_s, "time limit for the other hosts to become ready (60)");
    command->callback([=, &selected] { selected = [options] { return replay(*options); }; });
}

} // namespace tandem::command
