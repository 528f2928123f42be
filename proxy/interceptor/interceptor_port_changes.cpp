// SPDX-License-Identifier: Apache-2.0
// InterceptorComp: what it does when an RTC behind the link adds or removes ports.
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

/// Ends what a composite, whose ports are those of its members, leaves connected. [task-thread]
void InterceptorComp::port_removed(const std::string& component, const std::string& name) {
    for (const auto& shared : shared_ports_) {
        if (!is_named(shared.entry, component, name) &&
            !(shared.entry.component == component && shared.service_port == name))
            continue;
        if (auto* mirror = find_mirror(shared)) mirror->disconnect_all();
        spdlog::warn("{}: port '{}' of {} was removed: nothing crosses there until it is added again",
                     getInstanceName(), shared.entry.name, component);
    }
}

/// Connects a port that has come back with its mirror. The other side has ports for those only that were there when the
/// link was set up. [task-thread]
void InterceptorComp::port_added(RTC::RTObject_impl& rtc, const std::string& name) {
    const std::string component = rtc.getInstanceName();
    bool known = false;
    try {
        for (auto& port : enumerate_ports(rtc)) {
            const bool is_it = port.entry.name == name || port.service_port == name;
            if (!is_it) continue;
            const auto shared =
                std::find_if(shared_ports_.begin(), shared_ports_.end(), [&](const auto& each) {
                    return is_named(each.entry, component, port.entry.name);
                });
            if (shared == shared_ports_.end()) continue;
            known = true;
            port.entry.name = shared->entry.name;
            port.service_port = shared->service_port;
            if (port.entry != shared->entry) {
                spdlog::error(
                    "{}: port '{}' of {} was added again and is {} '{}' now, {} '{}' before; start the RTM "
                    "host again to use it",
                    getInstanceName(), port.entry.name, component, port.entry.type, port.entry.signature,
                    shared->entry.type, shared->entry.signature);
                continue;
            }
            if (auto* mirror = find_mirror(port))
                mirror->disconnect_all(); // from a port that had the name before
            connect_port(port);
            spdlog::info("{}: port '{}' of {} is there again", getInstanceName(), port.entry.name, component);
        }
    } catch (const std::runtime_error& error) { // it cannot be connected, and the user is strict
        spdlog::error("{}: {}", getInstanceName(), error.what());
    } catch (const CORBA::Exception& error) { // the RTC is being deleted
        spdlog::error("{}: port '{}' of {} cannot be asked: {}", getInstanceName(), name, component,
                      error._name());
    }
    if (!known)
        spdlog::warn(
            "{}: port '{}' was added to {} after its ports were shared and is not shared; start the RTM host "
            "again, with the port added in the RTC's onInitialize",
            getInstanceName(), name, component);
}

} // namespace tandem::interceptor
