// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/share/shared_components.hpp"

#include "host/log/log.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tandem::adaptor {
namespace control = link::control;
using link::CallStatus;
using link::Reply;

namespace {

// The most attempts to send a state report. Repeats it only if the peer is connected and has not answered in time.
constexpr int report_attempts = 3;

} // namespace

link::PortTable SharedComponents::find(const std::vector<std::string>& names,
                                       const std::map<std::string, std::string>& interfaces,
                                       ComponentDirectory* directory, std::vector<std::string>& useless) {
    if (!directory && !names.empty())
        useless.emplace_back("property 'share': this engine does not show components to each other "
                             "(ComponentDirectory.h); nothing is shared");
    directory_ = directory;
    interfaces_ = interfaces;
    for (const auto& name : names) {
        if (!directory || find(name)) continue;
        if (!directory->find(name) || name == owner_) {
            useless.push_back(
                fmt::format("property 'share' names '{}', which is not another component of the "
                            "application; it has {}",
                            name, fmt::join(directory->names(), ", ")));
            continue;
        }
        components_.push_back(std::make_unique<SharedComponent>(name, *directory));
        describe(*components_.back(), table_);
    }
    return table_;
}

void SharedComponents::describe(const SharedComponent& component, link::PortTable& table) {
    for (const auto& line : component.describe(table, interfaces_))
        if (told_.insert(line).second) log::warn("{}: {}", owner_, line);
}

void SharedComponents::connect(link::Link& link, const SetArrivalListener& set_listener,
                               const std::function<void()>& ports_changed) {
    link_ = &link;
    set_listener_ = set_listener;
    for (const auto& port : table_.ports)
        find(port.component)->connect_port(owner_, port, link, set_listener_, call_timeout_);
    for (const auto& component : components_)
        component->watch(
            {[this, &component = *component] { link_->post([this, &component] { report(component); }); },
             ports_changed});
    ports_changed(); // a port may have been added since find()
}

std::optional<link::PortTable> SharedComponents::follow_ports() {
    link::PortTable now;
    for (const auto& component : components_) describe(*component, now);
    const auto removed = std::erase_if(table_.ports, [&](const link::Port& port) {
        const auto* present = now.find(port.name);
        if (present && present->is_same(port)) return false;
        log_removed(port, present);
        return true;
    });
    bool added = false;
    for (const auto& port : now.ports) {
        find(port.component)->connect_port(owner_, port, *link_, set_listener_, call_timeout_);
        if (table_.find(port.name)) continue;
        table_.ports.push_back(port);
        added = true;
        log::info("{}: port '{}' was added and is shared", owner_, port.name);
    }
    return added || removed != 0 ? std::optional(table_) : std::nullopt;
}

void SharedComponents::log_removed(const link::Port& port, const link::Port* now) {
    if (now)
        log::warn("{}: port '{}' is {} '{}' now, {} '{}' before; what is connected with it on the RTM side "
                  "is disconnected",
                  owner_, port.name, now->type, now->signature, port.type, port.signature);
    else
        log::warn("{}: port '{}' was removed: nothing crosses there until it is added again", owner_,
                  port.name);
    if (port.kind != link::PortKind::data_in) return;
    if (const auto lost = link_->reader(port).discard(); lost != 0)
        log::warn("{}: port '{}': {} messages under way are lost", owner_, port.name, lost);
}

void SharedComponents::disconnect() {
    for (const auto& component : components_) component->disconnect();
}

SharedComponent* SharedComponents::find(std::string_view name) const {
    const auto found = std::find_if(components_.begin(), components_.end(),
                                    [&](const auto& component) { return component->name() == name; });
    return found == components_.end() ? nullptr : found->get();
}

MirrorRequiredPort* SharedComponents::find_service(std::string_view name) const {
    for (const auto& component : components_)
        if (auto* service = component->find_service(name)) return service;
    return nullptr;
}

Reply SharedComponents::serve(const link::Request& request) {
    try {
        if (request.operation == control::configure) return configure(request);
        if (request.operation == control::bind) return bind(request);
        if (request.operation == control::listen) {
            link_->serve_listen(request.arguments);
            return {};
        }
    } catch (const link::LinkError& error) {
        return Reply::failure(CallStatus::bad_arguments, error.what());
    }
    if (request.operation != control::activate && request.operation != control::deactivate &&
        request.operation != control::reset && request.operation != control::exit)
        return Reply::failure(CallStatus::no_such_operation, "unknown command");
    const std::string name = control::decode_string(request.arguments);
    SharedComponent* component = find(name);
    if (!component)
        return Reply::failure(CallStatus::bad_arguments, fmt::format("no component '{}' is shared", name));
    const std::string error = component->execute(request.operation);
    return error.empty() ? Reply{CallStatus::ok, control::encode(component->report())}
                         : Reply::failure(CallStatus::exception, error);
}

Reply SharedComponents::bind(const link::Request& request) {
    const auto binding = control::decode_service_binding(request.arguments);
    for (const auto& component : components_)
        if (auto* port = component->find_required(binding.port)) {
            port->bind(binding);
            return {};
        }
    return Reply::failure(CallStatus::bad_arguments,
                          fmt::format("no required service port '{}' is shared", binding.port));
}

Reply SharedComponents::configure(const link::Request& request) {
    const auto setting = control::decode_setting(request.arguments);
    const auto refuse = [](const std::string& reason) {
        return Reply::failure(CallStatus::bad_arguments, reason);
    };
    auto* component = find(setting.component);
    if (!component) return refuse(fmt::format("no component '{}' is shared", setting.component));
    const auto names = component->property_names();
    if (std::find(names.begin(), names.end(), setting.name) == names.end()) // the component would not read it
        return refuse(fmt::format("component {} has no property {} (it has: {})", setting.component,
                                  setting.name,
                                  names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    if (!directory_->setProperty(setting.component, setting.name, setting.value))
        return refuse(fmt::format("there is no component '{}' any more", setting.component));
    component->property_set(setting.name, setting.value);
    log::info("{}: property '{}' of {} is set to '{}' by the RTM side", owner_, setting.name,
              setting.component, setting.value);
    return {};
}

void SharedComponents::peer_connected() {
    for (const auto& component : components_) report(*component);
}

void SharedComponents::peer_lost() {
    for (const auto& component : components_) component->peer_lost();
}

/// Tells the peer the component's state. An absent peer gets the state when it joins.
void SharedComponents::report(SharedComponent& component) {
    for (int attempt = 0; attempt < report_attempts && link_->is_up(); ++attempt)
        if (link_
                ->call({"", control::state, "", control::encode(component.report())},
                       control::command_timeout(call_timeout_))
                .status == CallStatus::ok)
            return;
    if (link_->is_up())
        log::error("{}: the RTM side did not get the state of {}: no reply within {} ms; property "
                   "'call_timeout' allows more",
                   owner_, component.name(), control::command_timeout(call_timeout_).count());
}

} // namespace tandem::adaptor
