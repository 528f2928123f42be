// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/manager/preconnect_entry.hpp"
#include <atomic>
#include <condition_variable>
#include <functional>
#include <map>
#include <thread>

namespace RTC {

/// Looks after connections with other processes, in a thread that begins with the first of them: ports whose
/// process has died are let go, and what preconnect asks for is made when the other side comes, and again
/// when it has been away. What somebody disconnects on purpose stays disconnected. Every call ends after a
/// time.
class ConnectionKeeper {
  public:
    ConnectionKeeper(Manager& manager, std::chrono::nanoseconds interval)
        : manager_(manager), interval_(interval) {}
    ~ConnectionKeeper() { stop(); }

    /// A pair of a line that shall stay connected: made already (`id`), or not yet (empty).
    void keep_connected(const PreconnectEntry& line, std::size_t other, const std::string& id,
                        const std::string& why_not);
    /// There is a connection with a remote port now.
    void start();
    /// A connection has ended because its other side was lost; that side is told, in case it still lives.
    void report_lost(const ConnectorProfile& profile);
    /// Something else that is due at each round (the name servers); after `every` in the first place.
    void add_periodic_task(std::function<void()> task, std::chrono::nanoseconds every);
    void stop();
    /// How long a peer may take to answer when it is told that a connection ends. At the end of the host it
    /// is one time for all of them: a peer that hangs is waited for once, however many there are.
    std::chrono::milliseconds disconnect_timeout() const;

  private:
    struct KeptConnection {
        PreconnectEntry line;
        std::size_t other;
        std::string id; // empty: not connected
        PortService_var first, second;
        std::string last_warning;
    };
    struct Task {
        std::function<void()> run;
        std::chrono::nanoseconds every;
        std::chrono::steady_clock::time_point due;
    };
    void start_thread();
    void run();
    void notify_disconnects();
    void check_peers();
    void restore(KeptConnection& kept);
    bool is_connected(const KeptConnection& kept);
    bool may_reconnect(const KeptConnection& kept);

    Manager& manager_;
    const std::chrono::nanoseconds interval_;
    std::mutex mutex_; // guards what follows
    std::condition_variable wake_;
    std::atomic<bool> stopping_ = false; // set under the mutex
    std::vector<ConnectorProfile> pending_disconnects_;
    std::vector<KeptConnection> new_connections_;
    std::vector<Task> tasks_;
    std::thread thread_;
    std::atomic<std::chrono::steady_clock::time_point> disconnect_deadline_{}; // zero: the host is not ending
    // the thread's own
    std::vector<KeptConnection> connections_;
    std::map<std::string, int>
        unanswered_checks_; // connection ids whose peer did not answer, and how often in a row
};

} // namespace RTC
