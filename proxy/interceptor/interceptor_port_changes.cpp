// SPDX-License-Identifier: Apache-2.0
// InterceptorComp: what it does when an RTC behind the link adds or removes ports. It makes or connects the mirrors, and
// publishes a new port table.
#include "host/log/log.hpp"
#include "proxy/interceptor/interceptor_comp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace tandem::interceptor {
namespace {

/// Whether the shared port is that of the RTC with this name, to which the RTC's may have been put in front.
bool is_named(const link::Port& shared, const std::string& component, const std::string& name) {
    return shared.component == component && (shared.name == name || shared.name == component + "." + name);
}

// An RTC that adds an EventInPort binds the events after that, perhaps in this moment.
constexpr std::chrono::milliseconds pause_between_events{10};
constexpr int max_looks_at_events = 20;

/// Whether the port is an EventInPort, whatever events it has.
bool takes_events(const RtcPort& port) { return port.entry.type == "any" || port.entry.is_event_in_port(); }

/// The ports of the RTC; of an EventInPort of that name with the events that it has when no more come.
std::vector<RtcPort> enumerate_when_bound(RTC::RTObject_impl& rtc, const std::string& name) {
    const auto events_of = [&](const std::vector<RtcPort>& ports) {
        const auto found = std::find_if(ports.begin(), ports.end(), [&](const auto& port) {
            return port.entry.name == name && takes_events(port);
        });
        return found == ports.end() ? nullptr : &found->entry.operations;
    };
    auto ports = enumerate_ports(rtc);
    for (int look = 0; look < max_looks_at_events && events_of(ports) != nullptr; ++look) {
        std::this_thread::sleep_for(pause_between_events);
        auto now = enumerate_ports(rtc);
        const auto *before = events_of(ports), *after = events_of(now);
        const bool complete = !after || (!after->empty() && *after == *before);
        ports = std::move(now);
        if (complete) break;
    }
    return ports;
}

} // namespace

/// The connections with a port wait for the peer's side of them, so not in the thread that changes the RTC's ports.
void InterceptorComp::watch_ports(RTC::RTObject_impl& rtc) {
    port_watchers_.push_back(
        std::make_unique<RtcPortWatcher>(rtc, [this, &rtc, name = std::string(rtc.getInstanceName())](
                                                  const std::string& port, RtcPortWatcher::Change change) {
            link_->post([this, &rtc, name, port, change] {
                // It may have been deleted meanwhile, with all its ports.
                if (RTC::Manager::instance().getComponent(name.c_str()) != &rtc) return;
                if (change == RtcPortWatcher::Change::removed)
                    port_removed(name, port);
                else
                    port_added(rtc, port);
            });
        }));
}

/// Also ends what a composite, whose ports are those of its members, leaves connected. [task-thread]
void InterceptorComp::port_removed(const std::string& component, const std::string& name) {
    for (const auto& shared : shared_ports_)
        if (is_named(shared.entry, component, name) ||
            (shared.entry.component == component && shared.service_port == name))
            end_sharing(shared);
    publish_ports();
}

void InterceptorComp::end_sharing(const RtcPort& shared) {
    if (auto* mirror = find_mirror(shared)) mirror->disconnect_all();
    std::uint64_t lost = 0;
    if (shared.entry.kind == link::PortKind::data_in && shared.entry.has_ring()) {
        auto& reader = link_->reader(shared.entry);
        reader.set_policy({}); // nothing is due any more
        lost = reader.discard();
    }
    std::erase_if(table_.ports, [&](const auto& port) { return port.name == shared.entry.name; });
    log::warn("{}: port '{}' of {} was removed: nothing crosses there until it is added again{}",
              getInstanceName(), shared.entry.name, shared.entry.component,
              lost == 0 ? "" : fmt::format("; {} messages under way are lost", lost));
}

/// [task-thread]
void InterceptorComp::port_added(RTC::RTObject_impl& rtc, const std::string& name) {
    const std::string component = rtc.getInstanceName();
    std::vector<RtcPort> new_ports;
    try {
        for (auto& port : enumerate_when_bound(rtc, name)) {
            if (port.entry.name != name && port.service_port != name) continue;
            const auto shared =
                std::find_if(shared_ports_.begin(), shared_ports_.end(), [&](const auto& each) {
                    return is_named(each.entry, component, port.entry.name);
                });
            if (shared != shared_ports_.end())
                share_again(*shared, std::move(port));
            else
                new_ports.push_back(std::move(port));
        }
        share_new_ports(std::move(new_ports));
    } catch (const std::runtime_error& error) { // it cannot be connected, and the user is strict
        log::error("{}: {}", getInstanceName(), error.what());
    } catch (const CORBA::Exception& error) { // the RTC is being deleted
        log::error("{}: port '{}' of {} cannot be asked: {}", getInstanceName(), name, component,
                   error._name());
    }
    publish_ports();
}

/// Connects a port that has come back with its mirror.
void InterceptorComp::share_again(RtcPort& shared, RtcPort port) {
    const std::string& name = shared.entry.name;
    port.entry.name = name;
    port.service_port = shared.service_port;
    if (port.entry != shared.entry) return change_type(shared, port);
    if (auto* mirror = find_mirror(port)) mirror->disconnect_all(); // from a port that had the name before
    if (port.entry.kind == link::PortKind::data_in && port.entry.has_ring()) {
        link_->reader(port.entry).discard();
        set_policy(port);
    }
    connect_port(port);
    if (!table_.find(name)) table_.ports.push_back(port.entry);
    log::info("{}: port '{}' of {} is there again", getInstanceName(), name, port.entry.component);
}

/// The port has become another one: it gets a mirror of its own, or that which it had when it was like this before.
void InterceptorComp::change_type(RtcPort& shared, const RtcPort& port) {
    const auto &now = port.entry, &before = shared.entry;
    const std::string change =
        fmt::format("port '{}' of {} was added again and is {} '{}' now, {} '{}' before", now.name,
                    now.component, now.type, now.signature, before.type, before.signature);
    if (!link::is_data_port(now.kind) && !link::is_data_port(before.kind)) {
        log::warn("{}: {}", getInstanceName(), change);
        return change_interface(shared, port);
    }
    if (!link::is_data_port(now.kind) || !link::is_data_port(before.kind)) {
        log::error("{}: {}; start the RTM host again to use it", getInstanceName(), change);
        return;
    }
    log::warn("{}: {}", getInstanceName(), change);
    std::erase_if(table_.ports, [&](const auto& each) { return each.name == now.name; });
    if (auto* mirror = find_data_mirror(before)) hide(*mirror);
    shared = port;
    if (auto* mirror = find_data_mirror(now)) {
        if (now.kind == link::PortKind::data_in) link_->reader(now).discard();
        set_policy(port);
        show(*mirror);
        connect_port(port);
    } else {
        create_mirror_ports({port});
    }
    table_.ports.push_back(now);
    publish_listened_channels(); // of listeners that the RTC has added with the port
}

/// The service port gets another CORBA port with its present interfaces. Their mirrors stay for calls under way, and for
/// the case that the interface comes back.
void InterceptorComp::change_interface(RtcPort& shared, const RtcPort& port) {
    auto& mirror = service_ports_.at(port.service_port);
    removePort(*mirror); // ends its connections
    mirror.reset();
    shared = port;
    for (const auto& each : shared_ports_)
        if (each.service_port == port.service_port) create_service_mirror(each);
    addPort(*mirror);
    // Service ports of an active component can be called from its activation on, which is over.
    if (activation_->owner_is_active()) static_cast<RTC::PortBase&>(*mirror).activateInterfaces();
    connect_port(port);
    std::erase_if(table_.ports, [&](const auto& each) { return each.name == port.entry.name; });
    table_.ports.push_back(port.entry);
}

/// Makes mirrors of ports that were not there before, and connects them.
void InterceptorComp::share_new_ports(std::vector<RtcPort> ports) {
    if (ports.empty()) return;
    for (auto& port : ports) {
        const auto has_name = [&](const RtcPort& each) {
            return each.entry.name == port.entry.name ||
                   (!port.service_port.empty() && each.service_port == port.service_port);
        };
        // Of another RTC: the new port gets the name of its RTC in front.
        if (!std::any_of(shared_ports_.begin(), shared_ports_.end(), has_name)) continue;
        const std::string prefix = port.entry.component + ".";
        port.entry.name = prefix + port.entry.name;
        if (!port.service_port.empty()) port.service_port = prefix + port.service_port;
    }
    create_mirror_ports(ports);
    for (auto& port : ports) {
        // Service ports of an active component can be called from its activation on, which is over.
        if (!port.service_port.empty() && activation_->owner_is_active())
            static_cast<RTC::PortBase&>(*service_ports_.at(port.service_port)).activateInterfaces();
        table_.ports.push_back(port.entry);
        log::info("{}: port '{}' was added to {} and is shared", getInstanceName(), port.entry.name,
                  port.entry.component);
        shared_ports_.push_back(std::move(port));
    }
    publish_listened_channels(); // of listeners that the RTC has added with the port
}

void InterceptorComp::publish_ports() { link_->set_ports(table_); }

} // namespace tandem::interceptor
