// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/mirror_ports.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace tandem::adaptor {
using link::PortKind;

void MirrorPorts::create(const link::PortTable& peer, Component& owner) {
    for (const auto& name : settings_.event_ports)
        if (const auto* port = peer.find(name); !port || !link::is_data_port(port->kind))
            spdlog::error("{}: property 'event_ports' names '{}', which is no data port of {}", owner.getId(),
                          name, peer.component_names());
    for (const auto& port : peer.ports) {
        if (port.has_ring()) set_policy(port);
        create_mirror(port, owner);
    }
}

void MirrorPorts::set_policy(const link::Port& port) {
    auto policy = link::read_port_policy("property", port.name, [this](const std::string& name) {
        const auto at = settings_.policies.find(name);
        return at == settings_.policies.end() ? std::string() : at->second;
    });
    add_queue_policy(port.queue, policy);
    if (port.kind == PortKind::data_in)
        link_.writer(port.name).set_policy(policy);
    else
        link_.reader(port.name).set_policy(policy);
}

bool MirrorPorts::is_event_port(const link::Port& port) const {
    const auto& events = settings_.event_ports;
    return link::is_data_port(port.kind) &&
           std::find(events.begin(), events.end(), port.name) != events.end();
}

void MirrorPorts::create_mirror(const link::Port& port, Component& owner) {
    const std::string& name = port.name;
    const bool is_event = is_event_port(port);
    switch (port.kind) {
    case PortKind::data_in:
        if (port.is_event_in_port())
            add(fsm_ports_, port, owner, link_.writer(name));
        else if (is_event)
            add(event_inputs_, port, owner, link_.writer(name));
        else
            add(inputs_, port, owner, link_.writer(name), settings_.conversion(name));
        break;
    case PortKind::data_out:
        if (is_event)
            add(event_outputs_, port, owner, link_.reader(name), listen_to(name));
        else
            add(outputs_, port, owner, link_.reader(name), listen_to(name), settings_.conversion(name));
        break;
    case PortKind::service_provided:
        owner.addPort(name, new MirrorProvidedPort(port, link_, settings_.call_timeout));
        break;
    case PortKind::service_required:
        required_.push_back(new MirrorRequiredPort(port));
        owner.addPort(name, required_.back());
        break;
    }
}

/// Makes a mirror of the port from it and the arguments, keeps it in `mirrors` and adds it to the owner.
template <class Mirror, class... Arguments>
void MirrorPorts::add(std::vector<std::unique_ptr<Mirror>>& mirrors, const link::Port& port, Component& owner,
                      Arguments&&... arguments) {
    mirrors.push_back(std::make_unique<Mirror>(port, std::forward<Arguments>(arguments)...));
    owner.addPort(port.name, mirrors.back().get());
}

std::function<void(DataPortListener*)> MirrorPorts::listen_to(const std::string& port) const {
    return [this, port](DataPortListener* listener) { listen_(port, listener); };
}

[[gnu::hot]] MirrorRequiredPort* MirrorPorts::find_required(std::string_view name) const {
    for (auto* port : required_)
        if (port->port() == name) return port;
    return nullptr;
}

std::string MirrorPorts::first_refusal() const {
    for (const auto& port : inputs_)
        if (!port->refusals().empty()) return port->refusals().front();
    for (const auto& port : outputs_)
        if (!port->refusals().empty()) return port->refusals().front();
    return "";
}

} // namespace tandem::adaptor
