// SPDX-License-Identifier: Apache-2.0
// The command lines of `tandem top` and `tandem graph`.
#include "apps/tandem/commands.hpp"
#include "apps/tandem/top/commands.hpp"

#include <memory>

namespace tandem::command {
namespace {

void add_top(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<TopOptions>();
    CLI::App* command = add_command(
        tandem, "top", "Shows hosts, ports and calls of running links, again and again",
        "A verdict; hosts with their share of a core since the last picture; ports with rate over 2\n"
        "s, age of messages when they are read over 5 s, messages lost since the segment was created,\n"
        "waiting, time since the last one; ticks with the latest since they began; calls. Reads\n"
        "shared memory and /proc: no host notices. On a terminal the picture is drawn in place,\n"
        "Ctrl-C ends it; elsewhere one follows the other.");
    command->add_option("LINK", options->links, "names of links (all)");
    command->add_option("--period", options->period_s, "time between two pictures (1)")
        ->type_name("SECONDS")
        ->check(CLI::Range(0.1, 86400.0));
    command->add_option("-n,--count", options->count, "end after so many pictures")->type_name("N");
    command->add_flag("--json", options->json,
                      "a line of JSON for each picture, as /api/state of tandem monitor");
    command->callback([=, &selected] { selected = [options] { return top(*options); }; });
}

void add_graph(CLI::App& tandem, Action& selected) {
    auto options = std::make_shared<GraphOptions>();
    CLI::App* command = add_command(
        tandem, "graph", "Shows what running links connect",
        "Hosts, the components that they share, and the ports between them with messages per second\n"
        "over half a second.\n"
        "In drawings red cannot be connected, grey has been silent for 2 s, dashed are services.\n"
        "Exit code 1 if there is no such link, or for --svg no dot (package graphviz).");
    command->add_option("LINK", options->links, "names of links (all)");
    auto* format = command->add_option_group("format")->require_option(0, 1);
    const auto add = [&](const char* name, GraphFormat value, const char* description) {
        format->add_flag_callback(
            name, [options, value] { options->format = value; }, description);
    };
    add("--dot", GraphFormat::dot, "in the language of Graphviz");
    add("--svg", GraphFormat::svg, "drawn by Graphviz");
    add("--json", GraphFormat::json, "as /api/state of tandem monitor");
    command->callback([=, &selected] { selected = [options] { return graph(*options); }; });
}

} // namespace

void add_top_commands(CLI::App& tandem, Action& selected) {
    add_top(tandem, selected);
    add_graph(tandem, selected);
}

} // namespace tandem::command
