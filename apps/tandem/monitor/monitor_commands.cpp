// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem monitor`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/monitor/commands.hpp"

#include <memory>

namespace tandem::command {

void add_monitor_command(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<MonitorOptions>();
    CLI::App* command = add_command(
        tandem, "monitor",
        "Shows all running links in a browser, and serves metrics for Prometheus at /metrics",
        R"(Reads the links' shared memory without notifying or delaying either host. Prints the address of
the page. There is no password: anyone who can reach the address can read names and values.
Foxglove and Lichtblick connect to ws://ADDRESS:PORT.
Without --control the monitor is read-only. With --control, the printed address contains a token.
Clients with the token can activate, connect and configure RT-Components, start, stop, recover and
configure OPRoS components, record, replay recordings, and drive the wheelchair. With --systems
they can also make systems of the built components in DIR, and run them. Through Foxglove's
protocol, at ws://ADDRESS:PORT/?token=..., they can also publish to ports and call services.
Ends with Ctrl-C. Exit code 1 if it cannot listen at that address and port.)");
    command->add_option("LINK", options->links, "links to show, including links that do not exist yet (all)");
    command->add_option("--port", options->port, "TCP port; 0 selects a free one (8080)")
        ->check(CLI::Range(0, 65535))
        ->type_name("PORT");
    command->add_option("--bind", options->bind, "address to listen at (127.0.0.1, this machine only)")
        ->type_name("ADDRESS");
    command
        ->add_option("--allow-origin", options->other_origins,
                     "let pages of this origin read through Foxglove's protocol (repeatable)")
        ->type_name("ORIGIN");
    command
        ->add_option("--allow-host", options->allowed_hosts,
                     "let clients address the monitor by this name, besides localhost and the address "
                     "(repeatable)")
        ->type_name("NAME");
    CLI::Option* control = command->add_flag("--control", options->control,
                                             "let clients that have the printed token control the system");
    command
        ->add_option("--systems", options->systems,
                     "let these clients list, create, save, start and stop the systems in this folder")
        ->type_name("DIR")
        ->needs(control);
    command->callback([=, &selected] { selected = [options] { return monitor(*options); }; });
}

} // namespace tandem::command
