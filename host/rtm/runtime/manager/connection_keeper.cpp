// SPDX-License-Identifier: Apache-2.0
// Supervision of connections with other processes. OpenRTM-aist has none: it finds a dead peer when a caller requests a
// port's profile (PortBase::updateConnectors(), checkPorts()), and tries a preconnect entry once.
#include "host/rtm/runtime/manager/connection_keeper.hpp"
#include "host/process/start_thread.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/network/peer_process.hpp"
#include <algorithm>

namespace RTC {
namespace {

using std::chrono::steady_clock;

constexpr CORBA::ULong call_timeout_ms = 1000;
constexpr std::chrono::milliseconds max_disconnect_timeout{2000}, min_disconnect_timeout{50};
// One failed check is not enough: while a process is being replaced, its reference may fail briefly.
constexpr int checks_until_dead = 2;

bool has_connection(PortService_ptr port, const std::string& id) {
    ConnectorProfile_var profile = port->get_connector_profile(id.c_str());
    return profile->ports.length() > 0;
}

// Returns whether the object or its process no longer exists. A process that does not answer in time may be busy or
// stopped in a debugger, and the network to another machine may be down. Such peers count as alive.
bool is_dead(PortService_ptr port) {
    omniORB::setClientCallTimeout(port, call_timeout_ms);
    try {
        return port->_non_existent();
    } catch (const CORBA::TIMEOUT&) {
        return false;
    } catch (const CORBA::SystemException& e) {
        return address_on_another_machine(port).empty() || is_object_gone(e, port, true);
    }
}

// Returns the connection's name and its ports of this process. A connection that is made again has the same.
std::string describe_connection(const ConnectorProfile& profile) {
    std::string ports;
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i)
        if (auto port = local_object<PortBase>(profile.ports[i]))
            ports += (ports.empty() ? "" : " and ") + std::string(port->getName());
    return "connection " + std::string(profile.name) + " of " + ports;
}

} // namespace

/// The latest reason replaces the previous one.
void ConnectionKeeper::KeptConnection::show_refusal(const std::string& reason) {
    refusal.reset();
    refusal = std::make_unique<tandem::process::OwnRefusedConnection>(first_name(), second_name(), reason);
}

void ConnectionKeeper::keep_connected(const PreconnectEntry& entry, std::size_t index, PortService_ptr first,
                                      PortService_ptr second, const std::string& connector_id) {
    keep({entry, index, connector_id, PortService::_duplicate(first), PortService::_duplicate(second), ""});
}

void ConnectionKeeper::connect_when_available(const PreconnectEntry& entry, std::size_t index,
                                              const std::string& cause) {
    KeptConnection kept{entry, index, "", {}, {}, cause};
    kept.show_refusal(cause);
    keep(std::move(kept));
}

void ConnectionKeeper::activate_when_available(const std::string& component, const std::string& cause) {
    std::lock_guard<std::mutex> lock(mutex_);
    new_activations_.push_back({component, cause});
    start_checks();
}

void ConnectionKeeper::keep(KeptConnection connection) {
    std::lock_guard<std::mutex> lock(mutex_);
    new_connections_.push_back(std::move(connection));
    start_checks();
}

void ConnectionKeeper::start(const ConnectorProfile& profile) {
    forget_lost(profile);
    std::lock_guard<std::mutex> lock(mutex_);
    start_checks();
}

// With the mutex held.
void ConnectionKeeper::start_checks() {
    if (!checking_) next_check_ = steady_clock::now() + interval_;
    checking_ = true;
    start_thread();
    wake_.notify_all();
}

void ConnectionKeeper::forget_lost(const ConnectorProfile& profile) {
    const std::string connection = describe_connection(profile);
    std::lock_guard<std::mutex> lock(mutex_);
    lost_.erase(connection);
}

void ConnectionKeeper::report_lost(const ConnectorProfile& profile) {
    const std::string connection = describe_connection(profile);
    std::lock_guard<std::mutex> lock(mutex_);
    if (lost_.size() < tandem::process::Notices::places) // peers may choose any names
        lost_.try_emplace(connection, tandem::process::NoticeKind::lost,
                          connection + " is lost: the other side is gone; connect the ports again");
    pending_disconnects_.push_back(profile);
    start_thread();
    wake_.notify_all();
}

void ConnectionKeeper::add_periodic_task(std::function<void()> task, std::chrono::nanoseconds period) {
    std::lock_guard<std::mutex> lock(mutex_);
    tasks_.push_back({std::move(task), period, steady_clock::now() + period});
    start_thread();
    wake_.notify_all();
}

// With the mutex held. The next caller tries again.
void ConnectionKeeper::start_thread() {
    if (thread_.joinable() || stopping_) return;
    try {
        thread_ = tandem::process::start_thread([this] { run(); });
    } catch (const tandem::process::NotStarted& e) {
        Logger rtclog("connections");
        if (!has_warned_) RTC_WARN(("connections with other processes are not supervised: %s", e.what()));
        has_warned_ = true;
    }
}

void ConnectionKeeper::stop() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        stopping_ = true;
        disconnect_deadline_ = steady_clock::now() + max_disconnect_timeout;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

// The thread. It wakes up for each round of checks, for each task, and at once for a lost connection: a peer that is
// alive keeps its half of the connection until it is notified. With nothing to do the thread sleeps.
void ConnectionKeeper::run() {
    Lock lock(mutex_);
    while (!stopping_) {
        if (pending_disconnects_.empty()) {
            const auto next = next_wake();
            if (next == steady_clock::time_point::max())
                wake_.wait(lock);
            else
                wake_.wait_until(lock, next);
        }
        if (stopping_) return;
        std::move(new_connections_.begin(), new_connections_.end(), std::back_inserter(connections_));
        new_connections_.clear();
        std::move(new_activations_.begin(), new_activations_.end(), std::back_inserter(activations_));
        new_activations_.clear();
        const bool check = checking_ && steady_clock::now() >= next_check_;
        if (check) checking_ = false; // a connection made during the checks sets it again
        lock.unlock();
        notify_disconnects();
        if (check) {
            check_peers();
            for (auto& kept : connections_)
                if (!stopping_) restore(kept);
            std::erase_if(activations_, [this](auto& waiting) { return !stopping_ && activate(waiting); });
        }
        lock.lock();
        if (check && (has_remote_peers_ || !connections_.empty() || !activations_.empty())) start_checks();
        run_due_tasks(lock);
    }
}

// With the mutex held.
steady_clock::time_point ConnectionKeeper::next_wake() const {
    auto next = checking_ ? next_check_ : steady_clock::time_point::max();
    for (const auto& task : tasks_) next = std::min(next, task.due);
    return next;
}

// The lock is released during each task, so the list may grow meanwhile: it is walked by index.
void ConnectionKeeper::run_due_tasks(Lock& lock) {
    const auto now = steady_clock::now();
    for (std::size_t i = 0; i < tasks_.size() && !stopping_; ++i) {
        if (tasks_[i].due > now) continue;
        tasks_[i].due = now + tasks_[i].period;
        const auto task = tasks_[i].run;
        lock.unlock();
        task();
        lock.lock();
    }
}

void ConnectionKeeper::notify_disconnects() {
    std::vector<ConnectorProfile> disconnected;
    {
        std::lock_guard<std::mutex> lock(mutex_);
        disconnected.swap(pending_disconnects_);
    }
    for (auto& profile : disconnected) {
        // A kept connection without its id counts as lost, not as disconnected on purpose, and is therefore restored.
        for (auto& kept : connections_)
            if (kept.id == static_cast<const char*>(profile.connector_id)) {
                kept.id.clear();
                forget_lost(profile); // restore() shows it
            }
        for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
            PortService_ptr port = profile.ports[i];
            if (local_object<PortBase>(port) != nullptr || stopping_) continue;
            omniORB::setClientCallTimeout(port, call_timeout_ms);
            try {
                port->notify_disconnect(profile.connector_id);
            } catch (const CORBA::SystemException&) {
                continue; // the peer is dead, as was assumed
            }
        }
    }
}

// One round over all connections of all components of this process.
void ConnectionKeeper::check_peers() {
    std::map<std::string, int> failed_checks; // without the ids of connections that ended or recovered
    has_remote_peers_ = false;
    for (const auto& component : manager_.impl().references()) {
        if (stopping_) return;
        try {
            PortServiceList_var ports = component->get_ports();
            for (CORBA::ULong p = 0; p < ports->length(); ++p) {
                ConnectorProfileList_var connections = ports[p]->get_connector_profiles();
                for (CORBA::ULong c = 0; c < connections->length(); ++c)
                    check_connection(ports[p], connections[c], failed_checks);
            }
        } catch (const CORBA::SystemException&) {
            continue; // the component has exited since references()
        }
    }
    failed_checks_.swap(failed_checks);
}

void ConnectionKeeper::check_connection(PortService_ptr port, const ConnectorProfile& connection,
                                        std::map<std::string, int>& failed_checks) {
    if (!has_dead_peer(connection)) return;
    const std::string id(connection.connector_id);
    failed_checks[id] = failed_checks_[id] + 1;
    if (failed_checks[id] < checks_until_dead) return;
    if (auto local = local_object<PortBase>(port)) local->dropLostConnection(id.c_str());
}

bool ConnectionKeeper::has_dead_peer(const ConnectorProfile& connection) {
    for (CORBA::ULong i = 0; i < connection.ports.length() && !stopping_; ++i) {
        if (local_object<PortBase>(connection.ports[i]) != nullptr) continue;
        has_remote_peers_ = true;
        if (is_dead(connection.ports[i])) return true;
    }
    return false;
}

std::chrono::milliseconds ConnectionKeeper::disconnect_timeout() const {
    const auto deadline = disconnect_deadline_.load();
    if (deadline == steady_clock::time_point{}) return max_disconnect_timeout;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - steady_clock::now());
    return std::clamp(left, min_disconnect_timeout, max_disconnect_timeout);
}

// The local port knows the answer; the remote port would have to be called.
bool ConnectionKeeper::is_connected(const KeptConnection& kept) {
    if (kept.id.empty()) return false;
    PortService_var local =
        find_port(manager_, is_remote(kept.first_name()) ? kept.second_name() : kept.first_name());
    return has_connection(local.in(), kept.id);
}

// A connection that no longer exists, although its connector id was never cleared, was disconnected on purpose. The
// exception is a connection with a port that is now another object: the port's process was restarted before a check
// noticed.
bool ConnectionKeeper::may_reconnect(const KeptConnection& kept) {
    if (kept.id.empty()) return true;
    PortService_var first = find_port(manager_, kept.first_name());
    PortService_var second = find_port(manager_, kept.second_name());
    return !first->_is_equivalent(kept.first.in()) || !second->_is_equivalent(kept.second.in());
}

// Throws the exceptions of find_port() and connect_ports().
void ConnectionKeeper::connect(KeptConnection& kept) {
    if (is_connected(kept) || !may_reconnect(kept)) return kept.refusal.reset();
    kept.first = find_port(manager_, kept.first_name());
    kept.second = find_port(manager_, kept.second_name());
    kept.id = connect_ports(kept.entry, kept.index, kept.first.in(), kept.second.in());
    kept.last_cause.clear();
    kept.refusal.reset();
    Logger rtclog("connections");
    RTC_INFO(("%s: connected", kept.entry.port_names(kept.index, " and ").c_str()));
}

// Returns false if the component is still not available. A component that refuses is not asked again.
bool ConnectionKeeper::activate(WaitingActivation& waiting) {
    try {
        manager_.impl().activate_remote(waiting.component);
        return true;
    } catch (const RemoteUnavailable& e) {
        Logger rtclog("connections");
        if (waiting.last_cause != e.cause()) RTC_WARN(("%s; trying again until it works", e.what()));
        waiting.last_cause = e.cause();
        return false;
    }
}

void ConnectionKeeper::restore(KeptConnection& kept) {
    std::string warning, cause;
    try {
        connect(kept);
        return;
    } catch (const RemoteUnavailable& e) {
        warning = e.what();
        cause = e.cause();
        // ManagerError if a port refuses, which may change when another process runs there; or an exception of a local
        // port's listener.
    } catch (const std::runtime_error& e) {
        warning = e.what();
    } catch (const CORBA::SystemException& e) {
        warning = kept.second_name() + ": " + describe_exception(e);
    }
    if (cause.empty()) cause = warning;
    if (!kept.refusal) kept.show_refusal(warning);
    if (kept.last_cause == cause) return;
    Logger rtclog("connections");
    RTC_WARN(("%s; trying again until it works", warning.c_str()));
    kept.last_cause = cause;
    kept.show_refusal(warning);
}

} // namespace RTC
