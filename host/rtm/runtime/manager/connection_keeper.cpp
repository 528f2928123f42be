// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/manager/connection_keeper.hpp"
#include "host/rtm/runtime/component/local_object.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include <algorithm>

namespace RTC {
namespace {

constexpr CORBA::ULong call_timeout_ms = 1000;
constexpr std::chrono::milliseconds max_disconnect_timeout{2000}, min_disconnect_timeout{50};

bool has_connection(PortService_ptr port, const std::string& id) {
    ConnectorProfile_var profile = port->get_connector_profile(id.c_str());
    return profile->ports.length() > 0;
}

/// The object behind the reference is gone for good, or its process is. A process that does not answer may
/// live.
bool is_dead(PortService_ptr port) {
    omniORB::setClientCallTimeout(port, call_timeout_ms);
    try {
        return port->_non_existent();
    } catch (const CORBA::TIMEOUT&) {
        return false;
    } catch (const CORBA::SystemException&) {
        return true;
    }
}

} // namespace

void ConnectionKeeper::keep_connected(const PreconnectEntry& line, std::size_t other, const std::string& id,
                                      const std::string& why_not) {
    std::lock_guard<std::mutex> lock(mutex_);
    new_connections_.push_back({line, other, id, {}, {}, why_not});
    start_thread();
}

void ConnectionKeeper::start() {
    std::lock_guard<std::mutex> lock(mutex_);
    start_thread();
}

void ConnectionKeeper::report_lost(const ConnectorProfile& profile) {
    std::lock_guard<std::mutex> lock(mutex_);
    pending_disconnects_.push_back(profile);
    start_thread();
    wake_.notify_all();
}

void ConnectionKeeper::add_periodic_task(std::function<void()> task, std::chrono::nanoseconds every) {
    std::lock_guard<std::mutex> lock(mutex_);
    tasks_.push_back({std::move(task), every, std::chrono::steady_clock::now() + every});
    start_thread();
}

void ConnectionKeeper::start_thread() {
    if (!thread_.joinable() && !stopping_) thread_ = std::thread([this] { run(); });
}

void ConnectionKeeper::stop() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        stopping_ = true;
        disconnect_deadline_ = std::chrono::steady_clock::now() + max_disconnect_timeout;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void ConnectionKeeper::run() {
    auto next = std::chrono::steady_clock::now() + interval_;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!stopping_) {
        wake_.wait_until(lock, next, [this] { return stopping_ || !pending_disconnects_.empty(); });
        if (stopping_) return;
        std::move(new_connections_.begin(), new_connections_.end(), std::back_inserter(connections_));
        new_connections_.clear();
        lock.unlock();
        notify_disconnects();
        const auto now = std::chrono::steady_clock::now();
        if (now >= next) {
            next = now + interval_;
            check_peers();
            for (auto& kept : connections_)
                if (!stopping_) restore(kept);
        }
        lock.lock();
        for (std::size_t i = 0; i < tasks_.size() && !stopping_; ++i) {
            if (tasks_[i].due > now) continue;
            tasks_[i].due = now + tasks_[i].every;
            const auto task = tasks_[i].run;
            lock.unlock();
            task();
            lock.lock();
        }
    }
}

void ConnectionKeeper::notify_disconnects() {
    std::vector<ConnectorProfile> disconnected;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        disconnected.swap(pending_disconnects_);
    }
    for (auto& profile : disconnected) {
        for (auto& kept : connections_)
            if (kept.id == static_cast<const char*>(profile.connector_id)) kept.id.clear();
        for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
            PortService_ptr port = profile.ports[i];
            if (local_object<PortBase>(port) != nullptr || stopping_) continue;
            omniORB::setClientCallTimeout(port, call_timeout_ms);
            try {
                port->notify_disconnect(profile.connector_id);
            } catch (const CORBA::SystemException&) {
                continue; // it is gone indeed
            }
        }
    }
}

void ConnectionKeeper::check_peers() {
    std::map<std::string, int> unanswered;
    for (const auto& self : manager_.impl().references()) {
        if (stopping_) return;
        try {
            PortServiceList_var ports = self->get_ports();
            for (CORBA::ULong p = 0; p < ports->length(); ++p) {
                ConnectorProfileList_var connections = ports[p]->get_connector_profiles();
                for (CORBA::ULong c = 0; c < connections->length(); ++c) {
                    const ConnectorProfile& connection = connections[c];
                    const std::string id(connection.connector_id);
                    bool dead = false;
                    for (CORBA::ULong i = 0; i < connection.ports.length() && !dead; ++i)
                        dead = local_object<PortBase>(connection.ports[i]) == nullptr && !stopping_ &&
                               is_dead(connection.ports[i]);
                    if (!dead) continue;
                    // Twice in a row: a name that is being moved may miss a beat.
                    unanswered[id] = unanswered_checks_[id] + 1;
                    if (unanswered[id] < 2) continue;
                    if (auto port = local_object<PortBase>(ports[p])) port->forget(id.c_str());
                }
            }
        } catch (const CORBA::SystemException&) {
            continue; // the component is leaving
        }
    }
    unanswered_checks_.swap(unanswered);
}

std::chrono::milliseconds ConnectionKeeper::disconnect_timeout() const {
    const auto until = disconnect_deadline_.load();
    if (until == std::chrono::steady_clock::time_point{}) return max_disconnect_timeout;
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    return std::clamp(left, min_disconnect_timeout, max_disconnect_timeout);
}

bool ConnectionKeeper::is_connected(const KeptConnection& kept) {
    if (kept.id.empty()) return false;
    const bool first_here = !is_remote(kept.line.ports[0]);
    PortService_var here = find_port(manager_, kept.line.ports[first_here ? 0 : kept.other]);
    return has_connection(here.in(), kept.id);
}

// Not when both ports are the ones that were connected: then somebody has disconnected them.
bool ConnectionKeeper::may_reconnect(const KeptConnection& kept) {
    if (kept.id.empty() || CORBA::is_nil(kept.first.in())) return true;
    PortService_var first = find_port(manager_, kept.line.ports[0]);
    PortService_var second = find_port(manager_, kept.line.ports[kept.other]);
    return !first->_is_equivalent(kept.first.in()) || !second->_is_equivalent(kept.second.in());
}

void ConnectionKeeper::restore(KeptConnection& kept) {
    Logger rtclog("connections");
    try {
        if (is_connected(kept)) {
            if (!CORBA::is_nil(kept.first.in())) return;
            kept.first = find_port(manager_, kept.line.ports[0]); // made at start, by connectOrThrow()
            kept.second = find_port(manager_, kept.line.ports[kept.other]);
            return;
        }
        if (!may_reconnect(kept)) return;
        kept.first = find_port(manager_, kept.line.ports[0]);
        kept.second = find_port(manager_, kept.line.ports[kept.other]);
        kept.id = connect_ports(kept.line, kept.other, kept.first.in(), kept.second.in());
        RTC_INFO(
            ("%s and %s are connected", kept.line.ports[0].c_str(), kept.line.ports[kept.other].c_str()));
        kept.last_warning.clear();
    } catch (const std::runtime_error&
                 e) { // RemoteUnavailable, or a refusal that may be over when the other side is new
        if (kept.last_warning != e.what()) RTC_WARN(("%s; tried again until it works", e.what()));
        kept.last_warning = e.what();
    } catch (const CORBA::SystemException& e) {
        const std::string why = describe_exception(e);
        if (kept.last_warning != why)
            RTC_WARN(
                ("%s: %s; tried again until it works", kept.line.ports[kept.other].c_str(), why.c_str()));
        kept.last_warning = why;
    }
}

} // namespace RTC
