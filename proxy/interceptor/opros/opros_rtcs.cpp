// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/opros/opros_rtcs.hpp"

#include "host/log/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace tandem::interceptor {
namespace control = link::control;
using control::ComponentState;

namespace {

// An RTC that is being activated by another client gets its state after that.
constexpr int follow_attempts = 50;
constexpr std::chrono::milliseconds follow_pause{10};

std::vector<link::Port> ports_of(const link::PortTable& table, const std::string& component) {
    std::vector<link::Port> ports;
    // The names come from another process. A port whose name does not begin with the component's name is ignored.
    for (const auto& port : table.ports)
        if (port.component == component && port.name.starts_with(component + ".")) ports.push_back(port);
    return ports;
}

bool has_all(const std::vector<link::Port>& ports, const std::vector<link::Port>& wanted) {
    return std::all_of(wanted.begin(), wanted.end(), [&](const auto& port) {
        return std::any_of(ports.begin(), ports.end(), [&](const auto& each) { return each.is_same(port); });
    });
}

const link::SharedComponent* find_component(const link::PortTable& table, const std::string& name) {
    const auto found = std::find_if(table.components.begin(), table.components.end(),
                                    [&](const auto& component) { return component.name == name; });
    return found == table.components.end() ? nullptr : &*found;
}

} // namespace

OprosRtcs::OprosRtcs(std::string owner, RTC::Manager& manager, link::Link& link, std::string link_name,
                     std::chrono::milliseconds call_timeout, std::function<void()> connections_changed)
    : owner_(std::move(owner)), manager_(manager), link_(link), link_name_(std::move(link_name)),
      call_timeout_(call_timeout), connections_changed_(std::move(connections_changed)) {}

void OprosRtcs::set_peer_table(const link::PortTable& table, bool comes) {
    const std::lock_guard lock(mutex_);
    table_ = table;
    if (comes) reports_.clear();
}

void OprosRtcs::receive_state(const link::Request& request) {
    const auto report = control::decode_state_report(request.arguments);
    {
        const std::lock_guard lock(mutex_);
        if (!find_component(table_, report.component))
            throw link::LinkError(fmt::format("the peer shares no component '{}'", report.component));
        auto& newest = reports_[report.component];
        if (newest.sequence >= report.sequence) return;
        newest = report;
        // At once: an RTC whose component has failed must not look healthy until the task thread has the time.
        const auto entry = rtcs_.find(report.component);
        if (entry != rtcs_.end()) entry->second->rtc->remember(report);
    }
    link_.post([this, name = report.component] { follow(name); });
}

link::Reply OprosRtcs::serve(const link::Request& request) {
    std::shared_ptr<Entry> owner; // keeps the port for the time of the call
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [name, entry] : rtcs_)
            if (entry->rtc->find_required(request.port)) owner = entry;
    }
    // An OPRoS component may call before its RTC has the port here.
    if (!owner)
        return link::Reply::failure(link::CallStatus::not_ready,
                                    fmt::format("not ready: service port '{}' is not shown", request.port));
    return owner->rtc->find_required(request.port)->serve(request);
}

void OprosRtcs::update_ports() {
    std::map<std::string, std::vector<link::Port>> ports;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [name, entry] : rtcs_) ports[name] = ports_of(table_, name);
    }
    for (const auto& [name, now] : ports)
        if (auto* rtc = find(name)) rtc->set_ports(now);
}

void OprosRtcs::peer_connected() {
    std::vector<std::string> changed;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [name, entry] : rtcs_)
            if (!find_component(table_, name) || !has_all(ports_of(table_, name), entry->rtc->source().ports))
                changed.push_back(name);
    }
    for (const auto& name : changed) {
        log::info("{}: OPRoS component {} is no longer shared with the same ports", owner_, name);
        remove(name);
    }
    update_ports();
    // Settings that were made on this side also apply to the new peer.
    link::PortTable table;
    {
        const std::lock_guard lock(mutex_);
        table = table_;
    }
    for (const auto& component : table.components)
        if (auto* rtc = find(component.name)) {
            rtc->send_configuration(&component.properties);
            rtc->send_interfaces();
        }
    // The report that creates an RTC may have arrived before this task and found the RTC that this task has removed.
    for (const auto& name : changed) follow(name);
}

void OprosRtcs::peer_lost() {
    std::vector<std::shared_ptr<Entry>> all;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [name, entry] : rtcs_) all.push_back(entry);
    }
    for (const auto& entry : all) entry->rtc->peer_lost();
    for (const auto& entry : all) entry->rtc->follow();
}

/// Returns nullptr also for an RTC that is exiting. The result is valid in the task thread until this thread removes the RTC.
OprosRtc* OprosRtcs::find(const std::string& name) {
    const std::lock_guard lock(mutex_);
    const auto found = rtcs_.find(name);
    return found == rtcs_.end() || found->second->rtc->is_finalized() ? nullptr : found->second->rtc;
}

/// [task-thread]
void OprosRtcs::follow(const std::string& name) {
    control::StateReport report;
    {
        const std::lock_guard lock(mutex_);
        const auto found = reports_.find(name);
        if (found == reports_.end()) return; // this peer has sent no report, or another peer has come
        report = found->second;
    }
    if (report.state == ComponentState::destroyed) return remove(name);
    OprosRtc* rtc = find(name);
    if (!rtc) rtc = create(name);
    if (!rtc) return;
    rtc->remember(report);
    for (int attempt = 0; attempt < follow_attempts && !rtc->follow(); ++attempt)
        std::this_thread::sleep_for(follow_pause);
}

/// Creates and stores the RTC of the shared component. Returns nullptr if it is not shared any more, or, with a line in the log,
/// if the manager refuses it.
OprosRtc* OprosRtcs::create(const std::string& name) {
    OprosRtc::Source source;
    {
        const std::lock_guard lock(mutex_);
        const auto* component = find_component(table_, name);
        if (!component) return nullptr;
        source.component = *component;
        source.ports = ports_of(table_, name);
    }
    source.link = &link_;
    source.link_name = link_name_;
    source.call_timeout = call_timeout_;
    source.connections_changed = [this] { link_.post([this] { connections_changed_(); }); };
    source.configuration_changed = [this, name] {
        link_.post([this, name] {
            if (auto* rtc = find(name)) rtc->send_configuration();
        });
    };
    source.finalized = [this] { link_.post([this] { forget_finalized(); }); };
    try {
        OprosRtc& rtc = OprosRtc::create(manager_, std::move(source));
        const auto entry = std::make_shared<Entry>(rtc);
        {
            const std::lock_guard lock(mutex_);
            rtcs_[name] = entry;
        }
        log::info("{}: OPRoS component {} is shown as an RTC", owner_, name);
        rtc.send_configuration(); // what rtc.conf has set
        rtc.send_interfaces();
        return &rtc;
    } catch (const std::runtime_error& error) {
        log::error("{}: OPRoS component {} cannot be shown as an RTC: {}", owner_, name, error.what());
        return nullptr;
    }
}

void OprosRtcs::remove(const std::string& name) {
    std::shared_ptr<Entry> removed;
    {
        const std::lock_guard lock(mutex_);
        const auto found = rtcs_.find(name);
        if (found == rtcs_.end()) return;
        removed = found->second;
        rtcs_.erase(found);
    }
    removed->rtc->leave(manager_);
}

void OprosRtcs::forget_finalized() {
    const std::lock_guard lock(mutex_);
    std::erase_if(rtcs_, [](const auto& entry) { return entry.second->rtc->is_finalized(); });
}

std::vector<std::string> OprosRtcs::listened_channels() {
    std::vector<std::shared_ptr<Entry>> all;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [name, entry] : rtcs_)
            if (!entry->rtc->is_finalized()) all.push_back(entry);
    }
    std::vector<std::string> channels;
    for (const auto& entry : all)
        for (auto& channel : entry->rtc->listen()) channels.push_back(std::move(channel));
    return channels;
}

void OprosRtcs::close() {
    std::map<std::string, std::shared_ptr<Entry>> all;
    {
        const std::lock_guard lock(mutex_);
        all.swap(rtcs_);
    }
    for (const auto& [name, entry] : all) entry->rtc->leave(manager_);
}

} // namespace tandem::interceptor
