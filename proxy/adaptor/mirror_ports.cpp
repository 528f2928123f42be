// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/mirror_ports.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/engine/capabilities.hpp"
#include "proxy/adaptor/engine/ports.hpp"
#include "proxy/adaptor/property_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tandem::adaptor {
using link::PortKind;

namespace {

// A process that shares ever more ports under new names must not use up the memory of this process.
constexpr std::size_t max_mirrors = 4096;

} // namespace

void MirrorPorts::update(const link::PortTable& peer, Component& owner) {
    if (!engine::has_changing_ports && std::exchange(updated_, true)) return log_changes(peer, owner.getId());
    for (const auto& port : peer.ports) log_changed_type(port, owner.getId());
    for (auto& [name, mirror] : mirrors_) {
        const auto* port = peer.find(name);
        if (mirror.shown && (!port || !mirror.peer.is_same(*port))) hide(mirror, owner);
    }
    for (const auto& port : peer.ports) {
        if (auto* known = find_mirror(port)) {
            if (!known->shown) show(*known, owner);
            continue;
        }
        if (mirrors_.size() == max_mirrors) {
            log::error("{}: port '{}' of {} is not mirrored: there are {} others already; restart this host",
                       owner.getId(), port.name, port.component, max_mirrors);
            return;
        }
        if (port.has_ring()) set_policy(port);
        const auto& mirror = mirrors_.emplace(port.name, Mirror{port, create_mirror(port)})->second;
        owner.addPort(port.name, mirror.port); // last: the host may connect it now
    }
}

std::vector<std::string> MirrorPorts::find_useless_properties(const link::PortTable& peer) const {
    std::vector<std::string> properties;
    for (const auto& [port, names] : settings_.names) properties.push_back("names." + port);
    for (const auto& [port, operations] : settings_.operations) properties.push_back("operations." + port);
    for (const auto& [port, text] : settings_.conversions) properties.push_back("convert." + port);
    for (const auto& [property, value] : settings_.policies) properties.push_back(property);
    auto lines = find_properties_without_port(properties, peer);
    for (const auto& name : settings_.event_ports)
        if (const auto* port = peer.find(name); !port || !link::is_data_port(port->kind))
            lines.push_back(fmt::format("property 'event_ports' names '{}', which is not a data port of {}{}",
                                        name, peer.component_names(),
                                        port ? "" : "; it is an event port when it is added"));
    return lines;
}

/// Returns nullptr if there is no mirror of exactly this port.
MirrorPorts::Mirror* MirrorPorts::find_mirror(const link::Port& port) {
    const auto [begin, end] = mirrors_.equal_range(port.name);
    const auto found =
        std::find_if(begin, end, [&](const auto& each) { return each.second.peer.is_same(port); });
    return found == end ? nullptr : &found->second;
}

/// The host logs for each connection whether it can be made again.
void MirrorPorts::log_changed_type(const link::Port& port, const std::string& owner) {
    const auto [begin, end] = mirrors_.equal_range(port.name);
    const auto before = std::find_if(begin, end, [](const auto& each) { return each.second.shown; });
    if (before == end) return;
    const auto& old = before->second.peer;
    if (old.kind == port.kind && old.type == port.type && old.signature == port.signature) return;
    log::warn("{}: port '{}' of {} is {} '{}' now, {} '{}' before; its connections are made again where "
              "the types match",
              owner, port.name, port.component, port.type, port.signature, old.type, old.signature);
}

/// Logs changes if the mirrors stay as they are.
void MirrorPorts::log_changes(const link::PortTable& peer, const std::string& owner) {
    for (const auto& [name, mirror] : mirrors_)
        if (const auto* port = peer.find(name); !port || !mirror.peer.is_same(*port))
            log::warn("{}: port '{}' of {} {}: its connections here stay, but carry nothing", owner, name,
                      mirror.peer.component, port ? "is another one now" : "is gone");
    for (const auto& port : peer.ports)
        if (!mirrors_.contains(port.name))
            log::warn(
                "{}: port '{}' of {} is new: this engine connects no port that is added later; restart it",
                owner, port.name, port.component);
}

/// Discards the messages left in the port's ring, which are too old for the new receivers.
void MirrorPorts::show(Mirror& mirror, Component& owner) {
    const auto& name = mirror.peer.name;
    if (mirror.peer.kind == PortKind::data_out) link_.reader(mirror.peer).discard();
    if (mirror.peer.has_ring()) set_policy(mirror.peer);
    if (auto* required = dynamic_cast<engine::RequiredPort*>(mirror.port))
        required_.add(name, *required, link::port_id(name));
    mirror.shown = true;
    static_cast<void>(mirror.hidden.release()); // the owner owns it from here on
    owner.addPort(name, mirror.port);
}

void MirrorPorts::hide(Mirror& mirror, Component& owner) {
    const auto& name = mirror.peer.name;
    mirror.shown = false;
    engine::remove_port(owner, name); // the host ends its connections
    if (!link::is_data_port(mirror.peer.kind)) mirror.hidden.reset(mirror.port);
    if (mirror.peer.kind != PortKind::data_out) return;
    auto& reader = link_.reader(mirror.peer);
    reader.set_policy({}); // no deadline applies any more
    if (const auto lost = reader.discard(); lost != 0)
        log::warn("{}: port '{}' was removed: {} messages under way are lost", owner.getId(), name, lost);
}

void MirrorPorts::set_policy(const link::Port& port) {
    auto policy = link::read_port_policy("property", port.name, [this](const std::string& name) {
        const auto at = settings_.policies.find(name);
        return at == settings_.policies.end() ? std::string() : at->second;
    });
    add_queue_policy(port.queue, policy);
    if (port.kind == PortKind::data_in)
        link_.writer(port).set_policy(policy);
    else
        link_.reader(port).set_policy(policy);
}

bool MirrorPorts::is_event_port(const link::Port& port) const {
    const auto& events = settings_.event_ports;
    return link::is_data_port(port.kind) &&
           std::find(events.begin(), events.end(), port.name) != events.end();
}

/// Returns a port that this object owns, except for service ports, which the owner deletes.
Port* MirrorPorts::create_mirror(const link::Port& port) {
    const std::string& name = port.name;
    const bool is_event = is_event_port(port);
    switch (port.kind) {
    case PortKind::data_in:
        if (port.is_event_in_port())
            return add(fsm_ports_, port, link_.writer(port), settings_.names_of(name));
        if (is_event) return add(event_inputs_, port, link_.writer(port));
        return add(inputs_, port, link_.writer(port), settings_.conversion(name));
    case PortKind::data_out:
        if (is_event) return add(event_outputs_, port, link_.reader(port), listen_to(port));
        return add(outputs_, port, link_.reader(port), listen_to(port), settings_.conversion(name));
    case PortKind::service_provided:
        return new engine::ProvidedPort(settings_.with_operations(port), link_, settings_.call_timeout,
                                        settings_.names_of(name));
    case PortKind::service_required:
        break;
    }
    auto* required =
        new engine::RequiredPort(settings_.with_operations(port), bound_, settings_.names_of(name));
    required_.add(name, *required, link::port_id(name));
    return required;
}

/// Creates a mirror from the port and the arguments, and keeps it in `mirrors`.
template <class MirrorPort, class... Arguments>
Port* MirrorPorts::add(std::vector<std::unique_ptr<MirrorPort>>& mirrors, const link::Port& port,
                       Arguments&&... arguments) {
    mirrors.push_back(std::make_unique<MirrorPort>(port, std::forward<Arguments>(arguments)...));
    return mirrors.back().get();
}

std::function<void(engine::ArrivalListener*)> MirrorPorts::listen_to(const link::Port& port) const {
    return [this, port](engine::ArrivalListener* listener) { listen_(port, listener); };
}

std::string MirrorPorts::first_refusal() const {
    for (const auto& [name, mirror] : mirrors_)
        if (const auto* record = dynamic_cast<const RefusalRecord*>(mirror.port))
            if (auto refusal = record->first_refusal(); !refusal.empty()) return refusal;
    return "";
}

} // namespace tandem::adaptor
