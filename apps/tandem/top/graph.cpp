// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/state_json.hpp"
#include "apps/tandem/monitor/state_reader.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/top/commands.hpp"
#include "apps/tandem/top/graph_dot.hpp"
#include "apps/tandem/top/inside_connections.hpp"
#include "apps/tandem/top/named_links.hpp"
#include "host/process/run_command.hpp"
#include "host/text/join.hpp"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace tandem::command {
namespace {

using monitor::LinkState;
using shm::Side;

/// Time between the two reads that rates need.
constexpr std::chrono::milliseconds look_interval{500};

std::string host_text(const LinkState& link, Side side) {
    const auto& host = link.side(side);
    if (!host.has_process()) return "no host";
    return fmt::format("{} ({}{})", host.program.empty() ? monitor::model_of(link, side) : host.program,
                       format_pid(host.pid, host.pid_elsewhere),
                       host.gone || host.state == shm::PeerState::dead ? ", dead" : "");
}

std::string arrow_line(const LinkState& link, Side owner, bool from_owner, const std::string& component,
                       const std::string& name, const std::string& rest) {
    // A link of a process with itself belongs to a program that shows values, and has no second model.
    const auto& far = link.side(shm::other(owner));
    const bool itself = far.pid != 0 && far.pid == link.side(owner).pid;
    const std::string there = itself ? far.program : monitor::model_of(link, shm::other(owner));
    const std::string here = component.empty() ? monitor::model_of(link, owner) : component;
    return fmt::format("  {} -> {}  {}{}\n", from_owner ? here : there, from_owner ? there : here, name,
                       rest);
}

/// Returns the components of the hosts, and the connections that no link carries.
std::string inside_text(const monitor::State& state) {
    std::string text;
    const auto connections = inside_connections(state);
    for (const auto& host : state.hosts) {
        if (!host.inventory) continue;
        const std::string names = text::join(host.inventory->components, ", ",
                                             [](const auto& component) { return component.name; });
        text += fmt::format("{} (pid {}): {}\n", host.program, host.pid, names);
        for (const auto& [from_host, to_host, from, to] : connections.shown)
            if (from_host == &host)
                text += fmt::format("  {}.{} -> {}.{}{}\n", from->component, from->name, to->component,
                                    to->name, from->kind == "data" ? "" : "  " + from->kind);
    }
    if (connections.left_out != 0)
        text += fmt::format("connections that are not shown: {}\n", connections.left_out);
    return text;
}

std::string graph_text(const monitor::State& state) {
    std::string text;
    for (const auto& link : state.links) {
        text += fmt::format("{}: {}, {}\n", link.name, host_text(link, Side::first),
                            host_text(link, Side::second));
        if (!link.readable) text += "  " + link.reason + "\n";
        for (const auto& port : link.ports)
            text += arrow_line(link, port.owner, port.writer == port.owner, port.component, port.name,
                               port.damage.empty() ? fmt::format("  {:.1f}/s", port.sent_per_s)
                                                   : "  " + port.damage);
        for (const auto& port : link.shared_ports)
            text += arrow_line(link, port.owner, port.kind == "required" || port.kind == "out",
                               port.component, port.name,
                               (port.kind == "required" || port.kind == "provided" ? "  service" : "") +
                                   (port.mismatch.empty() ? std::string() : "  " + port.mismatch));
    }
    text += inside_text(state);
    for (const auto& refused : state.refused)
        text += fmt::format("{} (pid {}): {} and {} are not connected: {}\n", refused.program, refused.pid,
                            refused.from, refused.to, refused.reason);
    return text.empty() ? "no hosts are running\n" : text;
}

/// Runs Graphviz. Throws std::runtime_error if it fails.
std::string svg_of(const std::string& dot) {
    std::string svg, errors;
    try {
        const auto drawn = process::run_command({"dot", "-Tsvg"}, {.input = dot});
        if (drawn.exit_code() == 0) svg = drawn.output;
        errors = drawn.failure();
    } catch (const std::system_error&) { // the program is missing
        errors = "the program dot was not found: install the package graphviz, or use --dot";
    }
    if (svg.empty()) throw std::runtime_error("--svg: " + errors);
    return svg;
}

} // namespace

int graph(const GraphOptions& options) {
    monitor::StateReader reader(options.links);
    reader.read();
    std::this_thread::sleep_for(look_interval);
    const monitor::State state = reader.read();
    if (!state.error.empty()) throw std::runtime_error(state.error);
    require_links(state, options.links);
    switch (options.format) {
    case GraphFormat::text:
        print_text(graph_text(state));
        break;
    case GraphFormat::dot:
        print_data(graph_dot(state));
        break;
    case GraphFormat::svg:
        print_data(svg_of(graph_dot(state)));
        break;
    case GraphFormat::json:
        print_text(monitor::state_json(state, monitor::judge(state), {}, nullptr) + "\n");
        break;
    }
    return 0;
}

} // namespace tandem::command
