// SPDX-License-Identifier: Apache-2.0
// The command line of `tandem monitor`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/monitor/commands.hpp"

#include <memory>

namespace tandem::command {

void add_monitor_command(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<MonitorOptions>();
    CLI::App* command = add_command(
        tandem, "monitor", "Shows all running links in a browser, and to Prometheus at /metrics",
        "Reads the links' shared memory: neither host notices, waits or is told.\n"
        "Prints the address of the page. There is no password: whoever reaches the address sees names\n"
        "and values.\n"
        "Foxglove and Lichtblick connect to ws://ADDRESS:PORT.\n"
        "Nothing is controlled, unless with --control: then who has the token, which is a part of the\n"
        "printed address, activates, connects and sets up RT-Components, records, and drives the\n"
        "wheelchair; by Foxglove's protocol, at ws://ADDRESS:PORT/?token=..., also publishes to ports\n"
        "and calls services.\n"
        "Ends with Ctrl-C. Exit code 1 if it cannot listen at that address and port.");
    command->add_option("LINK", options->links,
                        "links to show, also such as are not there yet; all if there is none");
    command->add_option("--port", options->port, "TCP port (8080); 0: any free one")
        ->check(CLI::Range(0, 65535))
        ->type_name("PORT");
    command->add_option("--bind", options->bind, "address to listen at (127.0.0.1: this machine only)")
        ->type_name("ADDRESS");
    command
        ->add_option("--allow-origin", options->other_origins,
                     "a page from there may look as a client of Foxglove's protocol (repeatable)")
        ->type_name("ORIGIN");
    command->add_flag("--control", options->control, "control by who has the token that is printed");
    command->callback([=, &selected] { selected = [options] { return monitor(*options); }; });
}

} // namespace tandem::command
