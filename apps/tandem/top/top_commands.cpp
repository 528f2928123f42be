// SPDX-License-Identifier: Apache-2.0
// The command lines of `tandem top` and `tandem graph`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/top/commands.hpp"
#include "host/options/number_check.hpp"

#include <memory>

namespace tandem::command {
namespace {

void add_top(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<TopOptions>();
    CLI::App* command = add_command(
        tandem, "top", "Shows hosts, ports and calls of running links, updated every second",
        R"(Each update shows a verdict; hosts with their CPU use (share of a core, over at least 0.9 s); ports
with their rate over 2 s, the age of messages when read over 5 s, messages lost since the segment
was created, messages waiting, and time since the last message; ticks with the duration of their
cycles over 5 s and the largest delay since they began; calls. Reads shared memory and /proc
without notifying the hosts. On a terminal, updates in place until Ctrl-C; otherwise prints one
update after the other.
Exit code 1 if the link does not exist.)");
    command->add_option("LINK", options->links, "names of links (all)");
    command->add_option("--period", options->period_s, "time between two updates (1)")
        ->type_name("SECONDS")
        ->check(options::number_between(0.1, 86400.0));
    command->add_option("-n,--count", options->count, "end after N updates")->type_name("N");
    command->add_flag("--json", options->json,
                      "print one line of JSON per update, in the format of /api/state of tandem monitor");
    command->callback([=, &selected] { selected = [options] { return top(*options); }; });
}

void add_graph(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<GraphOptions>();
    CLI::App* command = add_command(
        tandem, "graph", "Shows the components and ports that running links connect",
        R"(Shows hosts, the components that they share, and the ports between them with messages per second,
measured over half a second; then all components of each host, and the connections between them.
In drawings, red ports cannot be connected, grey ports have been silent for 2 s, and dashed lines
are services.
Exit code 1 if the link does not exist, or if --svg finds no dot (package graphviz).)");
    command->add_option("LINK", options->links, "names of links (all)");
    auto* format = command->add_option_group("format")->require_option(0, 1);
    const auto add = [&](const char* name, GraphFormat value, const char* description) {
        format->add_flag_callback(
            name, [options, value] { options->format = value; }, description);
    };
    add("--dot", GraphFormat::dot, "print in the language of Graphviz");
    add("--svg", GraphFormat::svg, "print an SVG drawn by Graphviz");
    add("--json", GraphFormat::json, "print JSON in the format of /api/state of tandem monitor");
    command->callback([=, &selected] { selected = [options] { return graph(*options); }; });
}

} // namespace

void add_top_commands(CLI::App& tandem, Action& selected) {
    add_top(tandem, selected);
    add_graph(tandem, selected);
}

} // namespace tandem::command
