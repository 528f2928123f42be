// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/manager/connection_keeper.hpp"
#include "host/rtm/runtime/component/local_object.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <algorithm>

namespace RTC {
namespace {

constexpr CORBA::ULong call_bound_ms = 1000;
constexpr std::chrono::milliseconds goodbye_ms{2000}, least_goodbye_ms{50};

bool has_connection(PortService_ptr port, const std::string& id) {
    ConnectorProfile_var profile = port->get_connector_profile(id.c_str());
    return profile->ports.length() > 0;
}

/// The object behind the reference is gone for good, or its process is. A process that does not answer may
/// live.
bool is_dead(PortService_ptr port) {
    omniORB::setClientCallTimeout(port, call_bound_ms);
    try {
        return port->_non_existent();
    } catch (const CORBA::TIMEOUT&) {
        return false;
    } catch (const CORBA::SystemException&) {
        return true;
    }
}

} // namespace

void ConnectionKeeper::keep(const ConnectionLine& line, std::size_t other, const std::string& id,
                            const std::string& why_not) {
    std::lock_guard<std::mutex> lock(mutex_);
    new_kept_.push_back({line, other, id, {}, {}, why_not});
    begin();
}

void ConnectionKeeper::watch() {
    std::lock_guard<std::mutex> lock(mutex_);
    begin();
}

void ConnectionKeeper::lost(const ConnectorProfile& profile) {
    std::lock_guard<std::mutex> lock(mutex_);
    goodbyes_.push_back(profile);
    begin();
    wake_.notify_all();
}

void ConnectionKeeper::also(std::function<void()> task, std::chrono::nanoseconds every) {
    std::lock_guard<std::mutex> lock(mutex_);
    tasks_.push_back({std::move(task), every, std::chrono::steady_clock::now() + every});
    begin();
}

void ConnectionKeeper::begin() {
    if (!thread_.joinable() && !ending_) thread_ = std::thread([this] { run(); });
}

void ConnectionKeeper::stop() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        ending_ = true;
        goodbyes_until_ = std::chrono::steady_clock::now() + goodbye_ms;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void ConnectionKeeper::run() {
    auto next = std::chrono::steady_clock::now() + interval_;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ending_) {
        wake_.wait_until(lock, next, [this] { return ending_ || !goodbyes_.empty(); });
        if (ending_) return;
        std::move(new_kept_.begin(), new_kept_.end(), std::back_inserter(kept_));
        new_kept_.clear();
        lock.unlock();
        say_goodbye();
        const auto now = std::chrono::steady_clock::now();
        if (now >= next) {
            next = now + interval_;
            look_at_peers();
            for (auto& kept : kept_)
                if (!ending_) restore(kept);
        }
        lock.lock();
        for (std::size_t i = 0; i < tasks_.size() && !ending_; ++i) {
            if (tasks_[i].due > now) continue;
            tasks_[i].due = now + tasks_[i].every;
            const auto task = tasks_[i].run;
            lock.unlock();
            task();
            lock.lock();
        }
    }
}

void ConnectionKeeper::say_goodbye() {
    std::vector<ConnectorProfile> leaving;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        leaving.swap(goodbyes_);
    }
    for (auto& profile : leaving) {
        for (auto& kept : kept_)
            if (kept.id == static_cast<const char*>(profile.connector_id)) kept.id.clear();
        for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
            PortService_ptr port = profile.ports[i];
            if (local_object<PortBase>(port) != nullptr || ending_) continue;
            omniORB::setClientCallTimeout(port, call_bound_ms);
            try {
                port->notify_disconnect(profile.connector_id);
            } catch (const CORBA::SystemException&) {
                continue; // it is gone indeed
            }
        }
    }
}

void ConnectionKeeper::look_at_peers() {
    std::map<std::string, int> silent;
    for (const auto& self : manager_.impl().references()) {
        if (ending_) return;
        try {
            PortServiceList_var ports = self->get_ports();
            for (CORBA::ULong p = 0; p < ports->length(); ++p) {
                ConnectorProfileList_var connections = ports[p]->get_connector_profiles();
                for (CORBA::ULong c = 0; c < connections->length(); ++c) {
                    const ConnectorProfile& connection = connections[c];
                    const std::string id(connection.connector_id);
                    bool dead = false;
                    for (CORBA::ULong i = 0; i < connection.ports.length() && !dead; ++i)
                        dead = local_object<PortBase>(connection.ports[i]) == nullptr && !ending_ &&
                               is_dead(connection.ports[i]);
                    if (!dead) continue;
                    // Twice in a row: a name that is being moved may miss a beat.
                    silent[id] = silent_[id] + 1;
                    if (silent[id] < 2) continue;
                    if (auto port = local_object<PortBase>(ports[p])) port->forget(id.c_str());
                }
            }
        } catch (const CORBA::SystemException&) {
            continue; // the component is leaving
        }
    }
    silent_.swap(silent);
}

std::chrono::milliseconds ConnectionKeeper::goodbye_bound() const {
    const auto until = goodbyes_until_.load();
    if (until == std::chrono::steady_clock::time_point{}) return goodbye_ms;
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    return std::clamp(left, least_goodbye_ms, goodbye_ms);
}

bool ConnectionKeeper::stands(const Kept& kept) {
    if (kept.id.empty()) return false;
    const bool first_here = !is_remote(kept.line.ports[0]);
    PortService_var here = find_port(manager_, kept.line.ports[first_here ? 0 : kept.other]);
    return has_connection(here.in(), kept.id);
}

// Not when both ports are the ones that were connected: then somebody has disconnected them.
bool ConnectionKeeper::may_return(const Kept& kept) {
    if (kept.id.empty() || CORBA::is_nil(kept.first.in())) return true;
    PortService_var first = find_port(manager_, kept.line.ports[0]);
    PortService_var second = find_port(manager_, kept.line.ports[kept.other]);
    return !first->_is_equivalent(kept.first.in()) || !second->_is_equivalent(kept.second.in());
}

void ConnectionKeeper::restore(Kept& kept) {
    Logger rtclog("connections");
    try {
        if (stands(kept)) {
            if (!CORBA::is_nil(kept.first.in())) return;
            kept.first = find_port(manager_, kept.line.ports[0]); // made at start, by connectOrThrow()
            kept.second = find_port(manager_, kept.line.ports[kept.other]);
            return;
        }
        if (!may_return(kept)) return;
        kept.first = find_port(manager_, kept.line.ports[0]);
        kept.second = find_port(manager_, kept.line.ports[kept.other]);
        kept.id = connect_ports(kept.line, kept.other, kept.first.in(), kept.second.in());
        RTC_INFO(
            ("%s and %s are connected", kept.line.ports[0].c_str(), kept.line.ports[kept.other].c_str()));
        kept.said.clear();
    } catch (
        const std::runtime_error& e) { // NotThere, or a refusal that may be over when the other side is new
        if (kept.said != e.what()) RTC_WARN(("%s; tried again until it works", e.what()));
        kept.said = e.what();
    } catch (const CORBA::SystemException& e) {
        const std::string why = meaning(e);
        if (kept.said != why)
            RTC_WARN(
                ("%s: %s; tried again until it works", kept.line.ports[kept.other].c_str(), why.c_str()));
        kept.said = why;
    }
}

} // namespace RTC
