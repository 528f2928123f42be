// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/shared_ports.hpp"

#include "host/log/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

namespace tandem::interceptor {
namespace {

/// Returns whether the shared port is the RTC's port `name`. The RTC's name may precede the shared port's name.
bool is_named(const link::Port& shared, const std::string& component, const std::string& name) {
    return shared.component == component && (shared.name == name || shared.name == component + "." + name);
}

// An RTC binds the events of an EventInPort after it has added the port, perhaps at this moment.
constexpr std::chrono::milliseconds pause_between_events{10};
constexpr int max_looks_at_events = 20;

/// Returns whether the port is an EventInPort, with or without events.
bool takes_events(const RtcPort& port) { return port.entry.type == "any" || port.entry.is_event_in_port(); }

/// Returns the ports of the RTC. Waits until the EventInPort of this name, if there is one, gets no further events.
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

SharedPorts::SharedPorts(RTC::RTObject_impl& owner, link::Link& link, DataMirrors& data,
                         ServiceMirrors& services, const RtcActivation& activation,
                         std::function<void()> listened_changed)
    : owner_(owner), link_(link), data_(data), services_(services), activation_(activation),
      listened_changed_(std::move(listened_changed)) {}

void SharedPorts::share(const SharedRtcs& shared) {
    table_ = shared.table;
    create_mirrors(shared.ports);
    ports_ = shared.ports;
}

void SharedPorts::create_mirrors(const std::vector<RtcPort>& ports) {
    for (const auto& port : ports)
        if (port.service_port.empty()) data_.create(port);
    services_.create(ports);
    for (const auto& port : ports) connect(port);
}

void SharedPorts::connect(const RtcPort& port) {
    port.service_port.empty() ? data_.connect(port) : services_.connect(port);
}

void SharedPorts::disconnect(const RtcPort& port) {
    port.service_port.empty() ? data_.disconnect(port.entry) : services_.disconnect(port.service_port);
}

/// The activation of an active component is over, so a service port that is added later is activated here.
void SharedPorts::activate_like_owner(const RtcPort& port) {
    if (activation_.owner_is_active()) services_.activate(port.service_port);
}

/// Connecting a port waits for the peer. Therefore the task thread connects it, not the thread that changes the RTC's ports.
void SharedPorts::watch(RTC::RTObject_impl& rtc) {
    watchers_.push_back(
        std::make_unique<RtcPortWatcher>(rtc, [this, &rtc, name = std::string(rtc.getInstanceName())](
                                                  const std::string& port, RtcPortWatcher::Change change) {
            link_.post([this, &rtc, name, port, change] {
                // It may have been deleted meanwhile, with all its ports.
                if (RTC::Manager::instance().getComponent(name.c_str()) != &rtc) return;
                if (change == RtcPortWatcher::Change::removed)
                    port_removed(name, port);
                else
                    port_added(rtc, port);
            });
        }));
}

void SharedPorts::follow(const std::string& component, std::vector<RtcPort> ports) {
    const auto with_name = [](auto& among, const std::string& name) {
        return std::ranges::find_if(among, [&](const auto& port) { return port.entry.name == name; });
    };
    for (const auto& shared : ports_)
        if (shared.entry.component == component && table_.find(shared.entry.name) &&
            with_name(ports, shared.entry.name) == ports.end())
            end_sharing(shared);
    std::vector<RtcPort> new_ports;
    try {
        for (auto& port : ports) {
            const auto shared = with_name(ports_, port.entry.name);
            if (shared == ports_.end()) {
                new_ports.push_back(std::move(port));
            } else if (!table_.find(port.entry.name) ||
                       !shared->reference->_is_equivalent(port.reference.in())) {
                const auto reference = port.reference;
                share_again(*shared, std::move(port));
                shared->reference = reference;
            }
        }
        share_new(std::move(new_ports));
    } catch (const std::runtime_error& error) { // it cannot be connected, and `strict` is set
        log::error("{}: {}", owner_.getInstanceName(), error.what());
    }
    link_.set_ports(table_);
}

/// Also ends connections that a composite leaves behind: its ports are its members' ports. [task-thread]
void SharedPorts::port_removed(const std::string& component, const std::string& name) {
    for (const auto& shared : ports_)
        if (is_named(shared.entry, component, name) ||
            (shared.entry.component == component && shared.service_port == name))
            end_sharing(shared);
    link_.set_ports(table_);
}

void SharedPorts::end_sharing(const RtcPort& shared) {
    disconnect(shared);
    std::uint64_t lost = 0;
    if (shared.entry.kind == link::PortKind::data_in && shared.entry.has_ring()) {
        auto& reader = link_.reader(shared.entry);
        reader.set_policy({}); // nothing is due any more
        lost = reader.discard();
    }
    std::erase_if(table_.ports, [&](const auto& port) { return port.name == shared.entry.name; });
    log::warn("{}: port '{}' of {} was removed: nothing crosses there until it is added again{}",
              owner_.getInstanceName(), shared.entry.name, shared.entry.component,
              lost == 0 ? "" : fmt::format("; {} messages under way are lost", lost));
}

/// [task-thread]
void SharedPorts::port_added(RTC::RTObject_impl& rtc, const std::string& name) {
    const std::string component = rtc.getInstanceName();
    std::vector<RtcPort> new_ports;
    try {
        for (auto& port : enumerate_when_bound(rtc, name)) {
            if (port.entry.name != name && port.service_port != name) continue;
            const auto shared = std::find_if(ports_.begin(), ports_.end(), [&](const auto& each) {
                return is_named(each.entry, component, port.entry.name);
            });
            if (shared != ports_.end())
                share_again(*shared, std::move(port));
            else
                new_ports.push_back(std::move(port));
        }
        share_new(std::move(new_ports));
    } catch (const std::runtime_error& error) { // it cannot be connected, and `strict` is set
        log::error("{}: {}", owner_.getInstanceName(), error.what());
    } catch (const CORBA::Exception& error) { // the RTC is being deleted
        log::error("{}: port '{}' of {} cannot be asked: {}", owner_.getInstanceName(), name, component,
                   error._name());
    }
    link_.set_ports(table_);
}

/// Connects a port that has come back with its mirror.
void SharedPorts::share_again(RtcPort& shared, RtcPort port) {
    const std::string& name = shared.entry.name;
    port.entry.name = name;
    port.service_port = shared.service_port;
    if (port.entry != shared.entry) return change_type(shared, port);
    disconnect(port); // from a port that had the name before
    if (port.entry.kind == link::PortKind::data_in && port.entry.has_ring()) {
        link_.reader(port.entry).discard();
        data_.set_policy(port.entry);
    }
    connect(port);
    if (!table_.find(name)) table_.ports.push_back(port.entry);
    log::info("{}: port '{}' of {} is available again", owner_.getInstanceName(), name, port.entry.component);
}

/// Gives a port that was added again with another type another mirror, or the mirror that it had with this type before.
void SharedPorts::change_type(RtcPort& shared, const RtcPort& port) {
    const auto &now = port.entry, &before = shared.entry;
    const std::string change =
        fmt::format("port '{}' of {} was added again and is {} '{}' now, {} '{}' before", now.name,
                    now.component, now.type, now.signature, before.type, before.signature);
    if (!link::is_data_port(now.kind) && !link::is_data_port(before.kind)) {
        log::warn("{}: {}", owner_.getInstanceName(), change);
        return change_interface(shared, port);
    }
    if (!link::is_data_port(now.kind) || !link::is_data_port(before.kind)) {
        log::error("{}: {}; start the RTM host again to use it", owner_.getInstanceName(), change);
        return;
    }
    log::warn("{}: {}", owner_.getInstanceName(), change);
    std::erase_if(table_.ports, [&](const auto& each) { return each.name == now.name; });
    data_.hide(before);
    shared = port;
    if (data_.restore(now))
        data_.connect(port);
    else
        create_mirrors({port});
    table_.ports.push_back(now);
    listened_changed_(); // of listeners that the RTC has added with the port
}

void SharedPorts::change_interface(RtcPort& shared, const RtcPort& port) {
    shared = port;
    services_.replace(port.service_port, ports_);
    activate_like_owner(port);
    services_.connect(port);
    std::erase_if(table_.ports, [&](const auto& each) { return each.name == port.entry.name; });
    table_.ports.push_back(port.entry);
}

/// Makes mirrors of ports that were not there before, and connects them.
void SharedPorts::share_new(std::vector<RtcPort> ports) {
    if (ports.empty()) return;
    for (auto& port : ports) add_rtc_name_if_taken(port);
    create_mirrors(ports);
    for (auto& port : ports) {
        if (!port.service_port.empty()) activate_like_owner(port);
        table_.ports.push_back(port.entry);
        log::info("{}: port '{}' was added to {} and is shared", owner_.getInstanceName(), port.entry.name,
                  port.entry.component);
        ports_.push_back(std::move(port));
    }
    listened_changed_(); // of listeners that the RTC has added with the port
}

/// Puts the name of the RTC before the port's name if a port of another RTC has this name.
void SharedPorts::add_rtc_name_if_taken(RtcPort& port) const {
    const auto has_name = [&](const RtcPort& each) {
        return each.entry.name == port.entry.name ||
               (!port.service_port.empty() && each.service_port == port.service_port);
    };
    if (!std::any_of(ports_.begin(), ports_.end(), has_name)) return;
    const std::string prefix = port.entry.component + ".";
    port.entry.name = prefix + port.entry.name;
    if (!port.service_port.empty()) port.service_port = prefix + port.service_port;
}

} // namespace tandem::interceptor
