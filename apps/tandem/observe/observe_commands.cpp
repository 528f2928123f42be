// SPDX-License-Identifier: Apache-2.0
// The command lines of `tandem echo` and `tandem hz`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/observe/commands.hpp"
#include "host/options/number_check.hpp"

#include <memory>

namespace tandem::command {
namespace {

constexpr const char* passive_help =
    "Reads the link's shared memory without notifying or delaying either host. Follows the link\n"
    "when hosts restart. Ends with Ctrl-C.\n";

void add_link_and_ports(CLI::App* command, std::string& link, std::vector<std::string>& ports) {
    command->add_option("LINK", link, "name of the link (see tandem shm list)")->required();
    command->add_option("PORT", ports, "data ports (all)");
}

void add_echo(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<EchoOptions>();
    CLI::App* command = add_command(
        tandem, "echo", "Prints the messages of a link with the names of their members",
        std::string(passive_help) +
            R"(Prints one line of JSON per message. The line begins with the port's name unless one PORT or
--json was given.
Messages overwritten before they were copied are counted on standard error.
Exit code 1 if the link or port does not exist, or if --timeout passes without a message.)");
    add_link_and_ports(command, options->link, options->ports);
    command->add_option("-n,--count", options->count, "end after N messages")->type_name("N");
    command->add_option("--timeout", options->timeout_s, "end when no message has arrived for this long")
        ->type_name("SECONDS")
        ->check(options::nonnegative_number());
    command->add_flag("--json", options->json,
                      "add link, port, sequence number and time of sending to each line");
    command->callback([=, &selected] { selected = [options] { return echo(*options); }; });
}

void add_hz(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<HzOptions>();
    CLI::App* command =
        add_command(tandem, "hz", "Prints the rate and regularity of the messages of a link's ports",
                    std::string(passive_help) + "Looks for new messages every 0.2 ms. Intervals are measured "
                                                "between the times at which it sees them.\n"
                                                "Exit code 1 if the link or port does not exist.");
    add_link_and_ports(command, options->link, options->ports);
    command->add_option("--period", options->period_s, "print a table after each period (1)")
        ->type_name("SECONDS")
        ->check(options::number_between(0.01, 86400.0));
    command->add_option("--count", options->count, "end after N tables")->type_name("N");
    command->add_flag("--json", options->json, "print JSON instead of text, one line per period");
    command->callback([=, &selected] { selected = [options] { return hz(*options); }; });
}

} // namespace

void add_observe_commands(CLI::App& tandem, Action& selected) {
    add_echo(tandem, selected);
    add_hz(tandem, selected);
}

} // namespace tandem::command
