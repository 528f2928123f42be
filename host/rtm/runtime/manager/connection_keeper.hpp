// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/manager/connection_line.hpp"
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
    void keep(const ConnectionLine& line, std::size_t other, const std::string& id,
              const std::string& why_not);
    /// There is a connection with a remote port now.
    void watch();
    /// A connection has ended because its other side was lost; that side is told, in case it still lives.
    void lost(const ConnectorProfile& profile);
    /// Something else that is due at each round (the name servers); after `every` in the first place.
    void also(std::function<void()> task, std::chrono::nanoseconds every);
    void stop();
    /// How long a peer may take to answer when it is told that a connection ends. At the end of the host it
    /// is one time for all of them: a peer that hangs is waited for once, however many there are.
    std::chrono::milliseconds goodbye_bound() const;

  private:
    struct Kept {
        ConnectionLine line;
        std::size_t other;
        std::string id; // empty: not connected
        PortService_var first, second;
        std::string said;
    };
    struct Task {
        std::function<void()> run;
        std::chrono::nanoseconds every;
        std::chrono::steady_clock::time_point due;
    };
    void begin();
    void run();
    void say_goodbye();
    void look_at_peers();
    void restore(Kept& kept);
    bool stands(const Kept& kept);
    bool may_return(const Kept& kept);

    Manager& manager_;
    const std::chrono::nanoseconds interval_;
    std::mutex mutex_; // guards what follows
    std::condition_variable wake_;
    std::atomic<bool> ending_ = false; // set under the mutex
    std::vector<ConnectorProfile> goodbyes_;
    std::vector<Kept> new_kept_;
    std::vector<Task> tasks_;
    std::thread thread_;
    std::atomic<std::chrono::steady_clock::time_point> goodbyes_until_{}; // zero: the host is not ending
    // the thread's own
    std::vector<Kept> kept_;
    std::map<std::string, int> silent_; // connection ids whose peer did not answer, and how often in a row
};

} // namespace RTC
