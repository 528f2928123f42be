// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/top/graph_dot.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/top/inside_connections.hpp"

#include "host/text/quote.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

namespace tandem::command {
namespace {

using monitor::LinkState;
using shm::Side;

std::string host_id(const LinkState& link, Side side) {
    const auto& host = link.side(side);
    // A side without a process has a separate box for this link.
    return host.pid != 0 ? std::to_string(host.pid) : link.name + " " + name_of(side);
}

std::string host_label(const LinkState& link, Side side) {
    const auto& host = link.side(side);
    if (!host.has_process()) return "no host";
    const char* const state = host.gone || host.state == shm::PeerState::dead ? ", dead"
                              : host.state == shm::PeerState::stopped         ? ", stopped"
                                                                              : "";
    const std::string pid = host.pid != 0 ? std::to_string(host.pid) : format_pid(0, host.pid_elsewhere);
    return fmt::format("{} {}{}", host.program.empty() ? monitor::model_of(link, side) : host.program, pid,
                       state);
}

/// Returns the node of a link in a host: its proxy.
std::string link_node(const LinkState& link, Side side) {
    return text::quote_dot(host_id(link, side) + " link " + link.name);
}
std::string component_node(const LinkState& link, Side owner, const std::string& component) {
    return component.empty() ? link_node(link, owner)
                             : text::quote_dot(host_id(link, owner) + " " + component);
}

/// Returns the component of COMPONENT.PORT.
std::string component_of(const std::string& end) { return end.substr(0, end.rfind('.')); }
std::string refused_node(const monitor::RefusedConnectionState& refused, const std::string& end) {
    return text::quote_dot(std::to_string(refused.pid) + " " + component_of(end));
}

std::string inside_node(const monitor::HostState& host, const std::string& component) {
    return text::quote_dot(std::to_string(host.pid) + " " + component);
}

struct Box {
    std::string label;
    bool dead = false;
    std::set<std::string> nodes; ///< declarations
};

/// Returns the boxes by host id, so that a host on several links has one box.
std::map<std::string, Box> boxes_of(const monitor::State& state) {
    std::map<std::string, Box> boxes;
    for (const auto& link : state.links) {
        for (const Side side : {Side::first, Side::second}) {
            Box& box = boxes[host_id(link, side)];
            box.label = host_label(link, side);
            box.dead = link.side(side).gone || link.side(side).state == shm::PeerState::dead;
            box.nodes.insert(
                fmt::format("{} [label={} shape=cds]", link_node(link, side), text::quote_dot(link.name)));
        }
        const auto add = [&](Side owner, const std::string& component) {
            if (!component.empty())
                boxes[host_id(link, owner)].nodes.insert(fmt::format("{} [label={} shape=box]",
                                                                     component_node(link, owner, component),
                                                                     text::quote_dot(component)));
        };
        for (const auto& port : link.ports) add(port.owner, port.component);
        for (const auto& port : link.shared_ports) add(port.owner, port.component);
    }
    for (const auto& host : state.hosts) {
        if (!host.inventory) continue;
        Box& box = boxes[std::to_string(host.pid)];
        if (box.label.empty()) box.label = fmt::format("{} {}", host.program, host.pid);
        for (const auto& component : host.inventory->components)
            box.nodes.insert(fmt::format("{} [label={} shape=box]", inside_node(host, component.name),
                                         text::quote_dot(component.name)));
    }
    for (const auto& refused : state.refused)
        for (const auto& end : {refused.from, refused.to})
            boxes[std::to_string(refused.pid)].nodes.insert(fmt::format(
                "{} [label={} shape=box]", refused_node(refused, end), text::quote_dot(component_of(end))));
    return boxes;
}

std::string edges_of(const LinkState& link) {
    std::string text;
    const auto add = [&](const std::string& from, const std::string& to, const std::string& label,
                         const std::string& style) {
        text += fmt::format("  {} -> {} [label={}{}]\n", from, to, text::quote_dot(label), style);
    };
    for (const auto& port : link.ports) {
        const std::string component = component_node(link, port.owner, port.component),
                          other = link_node(link, shm::other(port.owner));
        const bool out = port.writer == port.owner;
        const bool silent = port.sent_per_s == 0 && (!port.silent_s || *port.silent_s >= silent_after_s);
        const std::string style = !port.damage.empty() ? " color=red fontcolor=red"
                                  : silent             ? " color=grey fontcolor=grey40"
                                                       : "";
        const std::string label = port.damage.empty() ? fmt::format("{} {:.1f}/s", port.name, port.sent_per_s)
                                                      : port.name + ": " + port.damage;
        add(out ? component : other, out ? other : component, label, style);
    }
    for (const auto& port : link.shared_ports) {
        const std::string component = component_node(link, port.owner, port.component),
                          other = link_node(link, shm::other(port.owner));
        const bool towards_owner = port.kind == "provided" || port.kind == "in";
        const std::string style =
            std::string(" style=dashed") + (port.mismatch.empty() ? "" : " color=red fontcolor=red");
        add(towards_owner ? other : component, towards_owner ? component : other,
            port.name + (port.mismatch.empty() ? "" : ": " + port.mismatch), style);
    }
    return text;
}

} // namespace

std::string graph_dot(const monitor::State& state) {
    std::string text =
        "digraph tandem {\n  rankdir=LR\n  node [fontname=\"sans-serif\"]\n  edge [fontname=\"sans-serif\" "
        "fontsize=10]\n";
    int number = 0;
    for (const auto& [id, box] : boxes_of(state)) {
        text += fmt::format("  subgraph cluster_{} {{\n    label={}\n", number++, text::quote_dot(box.label));
        if (box.dead) text += "    color=red\n    penwidth=3\n";
        for (const auto& node : box.nodes) text += "    " + node + "\n";
        text += "  }\n";
    }
    for (const auto& link : state.links)
        if (link.readable) text += edges_of(link);
    const auto connections = inside_connections(state);
    if (connections.left_out != 0)
        text += fmt::format("  label=\"connections that are not shown: {}\"\n", connections.left_out);
    for (const auto& [from_host, to_host, from, to] : connections.shown)
        text += fmt::format("  {} -> {} [label={}{}]\n", inside_node(*from_host, from->component),
                            inside_node(*to_host, to->component), text::quote_dot(from->name),
                            from->kind == "service" ? " style=dashed" : "");
    for (const auto& refused : state.refused)
        text += fmt::format("  {} -> {} [label={} color=red fontcolor=red]\n",
                            refused_node(refused, refused.from), refused_node(refused, refused.to),
                            text::quote_dot(refused.from + " and " + refused.to + " are not connected"));
    return text + "}\n";
}

} // namespace tandem::command
