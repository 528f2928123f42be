// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/published/notices.hpp"
#include "host/process/published/refused_connections.hpp"
#include "host/rtm/runtime/manager/preconnect_entry.hpp"
#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <thread>

namespace RTC {

/// Supervises connections with other processes, which OpenRTM-aist leaves to the user. Releases connections whose peer
/// has died. Makes the preconnect connections when the peer appears, and again when it comes back. Connections that a
/// user disconnects on purpose stay disconnected. Activates components of preactivation when they appear. The manager owns
/// this object. It has one thread, which starts when there is something to do. Every call to a peer has a time limit. Public
/// functions: [any-thread]
class ConnectionKeeper {
  public:
    /// `interval`: time between two checks of all peers (manager.peer_check_interval).
    ConnectionKeeper(Manager& manager, std::chrono::nanoseconds interval)
        : manager_(manager), interval_(interval) {}
    ~ConnectionKeeper() { stop(); }

    /// Keeps entry.ports[0] and entry.ports[index], which are `first` and `second`, connected from now on.
    /// `connector_id` is the id of the connection.
    void keep_connected(const PreconnectEntry& entry, std::size_t index, PortService_ptr first,
                        PortService_ptr second, const std::string& connector_id);
    /// Connects the two ports once both are available. `cause` is why they are not connected yet; it is already logged.
    void connect_when_available(const PreconnectEntry& entry, std::size_t index, const std::string& cause);
    /// Activates a component of another process once it is available. `cause` is as above.
    void activate_when_available(const std::string& component, const std::string& cause);
    /// Starts the checks of peers. Call it when a port has been connected with a remote one.
    void start(const ConnectorProfile& profile);
    /// Reports that a connection has been released because its peer was lost. The keeper notifies the peer: if it is
    /// alive after all, it would otherwise keep its half of the connection. Shows the loss to observers until a
    /// connection of this name has been made again.
    void report_lost(const ConnectorProfile& profile);
    /// Calls `task` in the keeper's thread every `period`, for the first time after one period.
    void add_periodic_task(std::function<void()> task, std::chrono::nanoseconds period);
    /// Ends the thread; nothing is restored or notified afterwards.
    void stop();
    /// Returns how long a peer may take to answer when it is notified of a disconnection. While the host ends, all
    /// peers share one time budget, of which this is the rest. So hanging peers delay the end only once, however many
    /// there are.
    std::chrono::milliseconds disconnect_timeout() const;

  private:
    struct KeptConnection {
        PreconnectEntry entry;
        std::size_t index;             // of the second port; 0: the first port is connected by itself
        std::string id;                // of the connector; empty: not connected
        PortService_var first, second; // nil until they have been found
        std::string last_cause;        // is logged once, not in each round
        std::unique_ptr<tandem::process::OwnRefusedConnection> refusal{}; // while it cannot be made

        void show_refusal(const std::string& reason);

        const std::string& first_name() const { return entry.ports[0]; }
        const std::string& second_name() const { return entry.ports[index]; }
    };
    struct WaitingActivation {
        std::string component;  // with its scheme
        std::string last_cause; // is logged once, not in each round
    };
    struct Task {
        std::function<void()> run;
        std::chrono::nanoseconds period;
        std::chrono::steady_clock::time_point due;
    };
    using Lock = std::unique_lock<std::mutex>;
    void keep(KeptConnection connection);
    void start_thread();
    void run();
    void run_due_tasks(Lock& lock);
    void forget_lost(const ConnectorProfile& profile);
    void notify_disconnects();
    void check_peers();
    void check_connection(PortService_ptr port, const ConnectorProfile& connection,
                          std::map<std::string, int>& failed_checks);
    bool has_dead_peer(const ConnectorProfile& connection);
    void start_checks();
    std::chrono::steady_clock::time_point next_wake() const;
    void restore(KeptConnection& kept);
    void connect(KeptConnection& kept);
    bool activate(WaitingActivation& waiting);
    bool is_connected(const KeptConnection& kept);
    bool may_reconnect(const KeptConnection& kept);

    Manager& manager_;
    const std::chrono::nanoseconds interval_;
    std::mutex mutex_; // guards what follows; not held during calls
    std::condition_variable wake_;
    std::atomic<bool> stopping_ = false; // set under the mutex; read without it between calls
    std::vector<ConnectorProfile> pending_disconnects_;
    std::map<std::string, tandem::process::OwnNotice>
        lost_; // by describe_connection(); connections that are not kept
    std::vector<KeptConnection> new_connections_;
    std::vector<WaitingActivation> new_activations_;
    std::vector<Task> tasks_;
    bool checking_ = false; // there may be connections to check
    std::chrono::steady_clock::time_point next_check_{};
    std::thread thread_;
    bool has_warned_ = false;                                                  // that there is no thread
    std::atomic<std::chrono::steady_clock::time_point> disconnect_deadline_{}; // zero: the host is not ending
    // Only used by the thread.
    std::vector<KeptConnection> connections_;
    std::vector<WaitingActivation> activations_;
    std::map<std::string, int> failed_checks_; // by connector id: how often in a row its peer was dead
    bool has_remote_peers_ = false;            // the last check has found one
};

} // namespace RTC
