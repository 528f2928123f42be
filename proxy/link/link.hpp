// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/channel.hpp"
#include "proxy/link/link_error.hpp"
#include "proxy/link/link_handler.hpp"
#include "proxy/link/port_table.hpp"
#include "proxy/link/request.hpp"
#include "proxy/link/ring_plan.hpp"

#include "shm/call/call_server.hpp"
#include "shm/segment/watcher.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tandem::link {

struct Session;

struct LinkOptions {
    std::string name;  ///< both halves give the same
    RingSizes rings{}; ///< of the data ports; of two large_bytes the larger counts
    std::size_t segment_bytes =
        4 * 1024 * 1024;      ///< that each half may lay out, beside the chunks of its rings
    unsigned max_workers = 8; ///< calls of the peer that may run at once
    shm::WaitOptions wait{};  ///< of calls, theirs and ours
};

/// One half of a link: shares its port table with the peer, moves data and calls, and survives the
/// peer's death: what was bound is unbound, and bound again when a peer with a fitting table has come.
class Link {
  public:
    /// `own` is the table to share, may be empty. The handler must outlive the link.
    Link(shm::Side side, LinkOptions options, PortTable own, LinkHandler& handler);
    ~Link();

    /// Joins the segment and starts the link's threads. Throws shm::Error when the segment cannot be had.
    /// From here on a segment that somebody truncates ends the session and not the process: the one place
    /// that installs shm's handler of SIGBUS.
    void open();
    /// Waits for the peer. Throws LinkError when it does not come in time or its table was refused.
    void wait_until_up(std::chrono::milliseconds bound, const std::string& peer);
    /// Ends all threads and leaves the segment. Afterwards nothing calls the handler any more.
    void close();

    bool up() const { return up_.load(std::memory_order_acquire); }
    const std::string& name() const { return options_.name; }

    /// Calls the peer's handler. Never waits longer than `timeout`. [any-thread but the link's]
    Reply call(const Request&, std::chrono::milliseconds timeout);

    /// Runs `task` in the task thread, after those posted before; nowhere once the link is closing.
    /// [any-thread]
    void post(std::function<void()> task);

    /// Ends of data ports by name, of both tables; made on first use and bound while the link is up.
    ChannelWriter& writer(const std::string& port);
    ChannelReader& reader(const std::string& port);

  private:
    void run_link();
    std::shared_ptr<Session> join() const;
    void rejoin();
    void wait_to_rejoin(std::chrono::milliseconds bound, const std::string& why);
    std::string end_reason(const Session&);
    bool has_corrupt_ring();
    bool peer_needs_larger_chunks(const Session&);
    void try_connect(const std::shared_ptr<Session>&);
    void bind(Session&, const PortTable&, bool own);
    void disconnect(const std::string& why);
    std::shared_ptr<Session> session() const;

    void run_worker();
    void serve(shm::IncomingCall);
    void start_worker();
    void run_tasks();

    const shm::Side side_;
    const LinkOptions options_;
    const PortTable own_;
    LinkHandler& handler_;

    mutable std::mutex mutex_; // session_, channels, refusal_, workers_, tasks_
    std::condition_variable changed_;
    std::shared_ptr<Session> session_;
    std::map<std::string, ChannelWriter> writers_;
    std::map<std::string, ChannelReader> readers_;
    std::string refusal_;
    std::deque<std::function<void()>> tasks_;

    std::atomic<bool> stopping_{false}, up_{false};
    shm::Watcher watcher_;
    std::thread link_thread_, task_thread_;
    std::vector<std::thread> workers_;
    unsigned idle_workers_ = 0;
    unsigned refused_joins_ = 0;      // [link-thread]
    std::size_t large_bytes_;         // [link-thread] asked for by either half so far
    std::size_t peer_loan_bytes_ = 0; // [link-thread] of the last peer, so that the next one finds them
};

} // namespace tandem::link
