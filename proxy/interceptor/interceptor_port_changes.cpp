// SPDX-License-Identifier: Apache-2.0
// InterceptorComp: what it does when an RTC behind the link adds or removes ports. It makes or connects the mirrors, and
// publishes a new port table.
#include "proxy/interceptor/interceptor_comp.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace tandem::interceptor {
namespace {

/// Whether the shared port is that of the RTC with this name, to which the RTC's may have been put in front.
bool is_named(const link::Port& shared, const std::string& component, const std::string& name) {
    return shared.component == component && (shared.name == name || shared.name == component + "." + name);
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
    for (const auto& shared : shared_ports_) {
        if (!is_named(shared.entry, component, name) &&
            !(shared.entry.component == component && shared.service_port == name))
            continue;
        if (auto* mirror = find_mirror(shared)) mirror->disconnect_all();
        std::uint64_t lost = 0;
        if (shared.entry.kind == link::PortKind::data_in && shared.entry.has_ring()) {
            auto& reader = link_->reader(shared.entry.name);
            reader.set_policy({}); // nothing is due any more
            lost = reader.discard();
        }
        std::erase_if(table_.ports, [&](const auto& port) { return port.name == shared.entry.name; });
        spdlog::warn("{}: port '{}' of {} was removed: nothing crosses there until it is added again{}",
                     getInstanceName(), shared.entry.name, component,
                     lost == 0 ? "" : fmt::format("; {} messages under way are lost", lost));
    }
    publish_ports();
}

/// [task-thread]
void InterceptorComp::port_added(RTC::RTObject_impl& rtc, const std::string& name) {
    const std::string component = rtc.getInstanceName();
    std::vector<RtcPort> new_ports;
    try {
        for (auto& port : enumerate_ports(rtc)) {
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
        spdlog::error("{}: {}", getInstanceName(), error.what());
    } catch (const CORBA::Exception& error) { // the RTC is being deleted
        spdlog::error("{}: port '{}' of {} cannot be asked: {}", getInstanceName(), name, component,
                      error._name());
    }
    publish_ports();
}

/// Connects a port that has come back with its mirror, unless it has become another one.
void InterceptorComp::share_again(const RtcPort& shared, RtcPort port) {
    const std::string& name = shared.entry.name;
    port.entry.name = name;
    port.service_port = shared.service_port;
    if (port.entry != shared.entry) {
        spdlog::error("{}: port '{}' of {} was added again and is {} '{}' now, {} '{}' before; start the RTM "
                      "host again to use it",
                      getInstanceName(), name, port.entry.component, port.entry.type, port.entry.signature,
                      shared.entry.type, shared.entry.signature);
        return;
    }
    if (auto* mirror = find_mirror(port)) mirror->disconnect_all(); // from a port that had the name before
    if (port.entry.kind == link::PortKind::data_in && port.entry.has_ring()) {
        link_->reader(name).discard();
        set_policy(port);
    }
    connect_port(port);
    if (!table_.find(name)) table_.ports.push_back(port.entry);
    spdlog::info("{}: port '{}' of {} is there again", getInstanceName(), name, port.entry.component);
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
        if (!port.service_port.empty() && own_driver_->is_active())
            service_ports_.at(port.service_port)->activateInterfaces();
        table_.ports.push_back(port.entry);
        spdlog::info("{}: port '{}' was added to {} and is shared", getInstanceName(), port.entry.name,
                     port.entry.component);
        shared_ports_.push_back(std::move(port));
    }
    publish_listened_channels(); // of listeners that the RTC has added with the port
}

void InterceptorComp::publish_ports() { link_->set_ports(table_); }

} // namespace tandem::interceptor
