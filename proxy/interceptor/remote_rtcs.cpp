// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/remote_rtcs.hpp"

#include "host/log/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tandem::interceptor {

RemoteRtcs::RemoteRtcs(std::string owner, const Settings& settings, Events events)
    : owner_(std::move(owner)), settings_(settings), events_(std::move(events)) {}

void RemoteRtcs::find(const std::vector<std::string>& names, SharedRtcs& shared) {
    const bool is_only = names.size() == 1;
    for (const auto& name : names) {
        if (!is_remote_name(name)) continue;
        const std::string component = instance_of(name);
        const auto is_taken = [&](const auto& other) { return other.name == component; };
        if (std::ranges::any_of(shared.table.components, is_taken))
            throw std::runtime_error(fmt::format(
                "parameter 'rtc' names two RTCs '{}'; give one of them a separate link", component));
        shared.table.components.push_back({component, remote_type});
        auto made = make(name, is_only);
        auto& rtc = *made;
        found_[component] = {&rtc, std::move(made)};
        std::string reason;
        for (auto& port : enumerate_remote_ports(rtc.find(reason), component, is_only)) {
            shared.table.ports.push_back(port.entry);
            shared.ports.push_back(std::move(port));
        }
        if (reason.empty()) continue;
        if (settings_.strict) throw std::runtime_error(reason);
        log::warn("{}: {}; trying again until it exists", owner_, reason);
    }
}

std::unique_ptr<RemoteRtc> RemoteRtcs::make(const std::string& name, bool is_only) const {
    const std::string component = instance_of(name);
    RemoteRtc::Events events;
    events.ports_changed = [this, component, is_only](const RTC::PortServiceList& services) {
        events_.ports_changed(component, enumerate_remote_ports(services, component, is_only));
    };
    events.gone = [this, component] { events_.gone(component); };
    events.failed = [this, component](const std::string& what) { events_.failed(component, what); };
    events.active = [this, component] { events_.active(component); };
    return std::make_unique<RemoteRtc>(RTC::Manager::instance(), owner_, name, settings_.call_timeout,
                                       std::move(events));
}

std::unique_ptr<RemoteRtc> RemoteRtcs::take(const std::string& name) {
    return std::move(found_.at(instance_of(name)).untaken);
}

void RemoteRtcs::watch() {
    for (const auto& [name, found] : found_) {
        found.rtc->resume();
        found.rtc->watch();
    }
}

void RemoteRtcs::resume(const std::string& rtc) { found_.at(rtc).rtc->resume(); }

} // namespace tandem::interceptor
