// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/published/notices.hpp"
#include "proxy/link/channel/channel_table.hpp"
#include "proxy/link/link_handler.hpp"
#include "proxy/link/protocol/port_types.hpp"
#include "proxy/link/session/link_state.hpp"
#include "proxy/link/session/session_joiner.hpp"
#include "proxy/link/task_queue.hpp"
#include "shm/segment/watcher.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tandem::link {

/// The supervisor thread of a link: joins the segment, connects when a peer has published a matching port table,
/// disconnects when the peer or the segment is lost, and starts again. Only this thread starts and ends sessions. It
/// never waits for the peer in a call, and sleeps while nothing happens to the segment. After a departure, it joins
/// the next session once the handler has finished with the last peer.
class PeerSupervisor {
  public:
    /// All references must outlive this object.
    PeerSupervisor(shm::Side side, const LinkOptions& options, PortTable own_ports, LinkHandler& handler,
                   LinkState& state, ChannelTable& channels, TaskQueue& tasks);
    ~PeerSupervisor() { stop(); }
    PeerSupervisor(const PeerSupervisor&) = delete;
    PeerSupervisor& operator=(const PeerSupervisor&) = delete;

    /// Joins the first session in the caller's thread, so that the caller gets errors, and starts the thread. Throws
    /// shm::Error.
    void start();
    /// Disconnects without telling the handler, and ends the thread. Call it after LinkState::start_closing().
    void stop();
    /// Makes the thread check the segment now, with a system call. [any-thread]
    void wake() { watcher_.interrupt(); }
    /// Makes the thread publish another table of this side's ports. [any-thread]
    void set_ports(PortTable own_ports);

  private:
    void run();
    void begin_session();
    void report_ignored_file(const std::string& path);
    void number_rings();
    void rejoin();
    void wait_to_rejoin(std::chrono::milliseconds delay, const std::string& reason);
    /// Returns, in one line, why the session must end, or an empty string while it can continue.
    std::string end_reason(const LinkSession& session) const;
    void watch_peer(const LinkSession& session);
    std::chrono::nanoseconds check_deadlines();
    void sleep_until_event(std::chrono::nanoseconds bound);
    void try_connect(LinkSession& session);
    bool chunks_suffice(const LinkSession& session);
    /// Returns, in one line, why the handler refused the peer, or an empty string if the channels are bound.
    std::string bind_to_peer(LinkSession& session, PortTable& peer);
    void publish_new_ports(LinkSession* session);
    void report_left_out(const std::string& what);
    void follow_peer_ports(LinkSession& session);
    void disconnect(const std::string& reason);
    /// Wakes threads that still wait in the last session. Returns false if no such thread is left.
    bool end_last_session();

    const shm::Side side_;
    const LinkOptions& options_;
    PortTable own_ports_;                        ///< changed only in the thread
    PortTable session_ports_;                    ///< those of them that the session has room for
    std::optional<process::OwnNotice> left_out_; ///< why the others are not shared, if there are any
    bool left_out_reported_ = false;             ///< in the log of this session
    PortTypes ring_numbers_;                     ///< of this session
    std::mutex next_ports_mutex_;
    std::optional<PortTable> next_ports_; ///< not published yet
    std::atomic<bool> ports_task_waits_{false};
    std::atomic<bool> departure_waits_{false}; ///< the handler has not finished with the last departure
    LinkHandler& handler_;
    LinkState& state_;
    ChannelTable& channels_;
    TaskQueue& tasks_;
    shm::Watcher watcher_; ///< wakes the thread when something happens to the segment or the peer's process
    SessionJoiner joiner_;
    bool peer_watched_ = false;           ///< the watcher watches the peer's process, or cannot
    std::chrono::nanoseconds settling_{}; ///< when to check again after a departure; 0: long ago
    bool peer_refused_ = false;           ///< in this session; another peer needs another session
    unsigned failed_rejoins_ = 0;         ///< since the last session
    bool ignored_file_reported_ = false;
    std::weak_ptr<LinkSession> last_session_;
    std::thread thread_;
};

} // namespace tandem::link
