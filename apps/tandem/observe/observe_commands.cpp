// SPDX-License-Identifier: Apache-2.0
// The command lines of `tandem echo` and `tandem hz`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/observe/commands.hpp"

#include <memory>

namespace tandem::command {
namespace {

constexpr const char* passive_help =
    "Reads the link's shared memory beside the receiver: neither host notices, waits or is\n"
    "told. Hosts may restart meanwhile. Ends with Ctrl-C.\n";

void add_link_and_ports(CLI::App* command, std::string& link, std::vector<std::string>& ports) {
    command->add_option("LINK", link, "name of the link; tandem shm list shows them")->required();
    command->add_option("PORT", ports, "data ports; all if there is none");
}

void add_echo(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<EchoOptions>();
    CLI::App* command = add_command(
        tandem, "echo", "Prints the messages that pass through a link, by the names of their members",
        std::string(passive_help) +
            "One line of JSON for each message, behind the port's name unless one port was chosen. "
            "What is overwritten\n"
            "before it was copied is counted on standard error.\n"
            "Exit code 1 if there is no such link or port, or with --timeout no message.");
    add_link_and_ports(command, options->link, options->ports);
    command->add_option("-n,--count", options->count, "end after so many messages")->type_name("N");
    command->add_option("--timeout", options->timeout_s, "end when no message came for so long")
        ->type_name("SECONDS")
        ->check(CLI::NonNegativeNumber);
    command->add_flag("--json", options->json, "with link, port, sequence number and time of sending");
    command->callback([=, &selected] { selected = [options] { return echo(*options); }; });
}

void add_hz(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<HzOptions>();
    CLI::App* command = add_command(
        tandem, "hz", "Prints how often messages pass through the ports of a link, and how regularly",
        std::string(passive_help) + "Intervals are those between the moments at which this "
                                    "program sees the messages, which it looks for\n"
                                    "every 0.2 ms.\n"
                                    "Exit code 1 if there is no such link or port.");
    add_link_and_ports(command, options->link, options->ports);
    command->add_option("--period", options->period_s, "print a table after each period (1)")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.01, 86400.0));
    command->add_option("--count", options->count, "end after so many tables")->type_name("N");
    command->add_flag("--json", options->json, "print JSON instead of text, a line for each period");
    command->callback([=, &selected] { selected = [options] { return hz(*options); }; });
}

} // namespace

void add_observe_commands(CLI::App& tandem, Action& selected) {
    add_echo(tandem, selected);
    add_hz(tandem, selected);
}

} // namespace tandem::command
