// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/peer_supervisor.hpp"

#include "host/log/log.hpp"
#include "host/process/start_thread.hpp"
#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/session/link_thread.hpp"

#include <system_error>
#include <utility>

namespace tandem::link {
namespace {

using namespace std::chrono_literals;

// After a departure, the thread checks again after 1, 2, 4, ... ms, for 1 s in total: a lock becomes free shortly
// after its owner's file is closed, and the closing process may have to wait for a processor.
constexpr std::chrono::nanoseconds first_settling = 1ms, max_settling = 512ms;
constexpr auto retry_taken_side = 1ms;
constexpr auto retry_join = 10ms;
constexpr int max_last_tries = 1'000; // of retry_taken_side
// Failures to join are normal during a restart. Only a lasting failure is logged, once per this many attempts.
constexpr unsigned rejoins_per_log_line = 100;

} // namespace

PeerSupervisor::PeerSupervisor(shm::Side side, const LinkOptions& options, PortTable own_ports,
                               LinkHandler& handler, LinkState& state, ChannelTable& channels,
                               TaskQueue& tasks)
    : side_(side), options_(options), own_ports_(std::move(own_ports)), handler_(handler), state_(state),
      channels_(channels), tasks_(tasks), watcher_(options.name), joiner_(side, options, own_ports_) {}

void PeerSupervisor::start() {
    begin_session();
    thread_ = process::start_thread([this] { run(); });
}

void PeerSupervisor::stop() {
    wake();
    if (thread_.joinable()) thread_.join();
}

void PeerSupervisor::begin_session() {
    ring_numbers_ = {};
    number_rings();
    auto session = joiner_.join();
    session_ports_ = own_ports_;
    left_out_.reset();
    left_out_reported_ = false;
    report_ignored_file(session->segment()->ignored_file());
    session->segment()->watch(watcher_); // before the first check, so that nothing is missed in between
    peer_watched_ = false;
    peer_refused_ = false;
    state_.start_session(std::move(session));
}

/// Logs once, because any user of the machine can create such a file.
void PeerSupervisor::report_ignored_file(const std::string& path) {
    if (path.empty() || std::exchange(ignored_file_reported_, true)) return;
    log::warn(
        "link '{}': {} belongs to another user and is ignored; if it is the other host's, run both hosts as "
        "one user, or set `group` on both sides",
        options_.name, path);
}

void PeerSupervisor::number_rings() {
    for (auto& port : own_ports_.ports) port.ring = ring_numbers_.number(port);
}

void PeerSupervisor::run() {
    begin_link_thread("tandem-link");
    while (!state_.is_closing()) {
        const auto session = state_.session();
        publish_new_ports(session.get());
        if (!session) {
            if (departure_waits_)
                watcher_.wait(shm::longest_wait);
            else
                rejoin();
            continue;
        }
        if (const std::string reason = end_reason(*session); !reason.empty()) {
            disconnect(reason);
            continue;
        }
        if (!peer_watched_) watch_peer(*session);
        if (!state_.is_up() && !peer_refused_ && session->segment()->peer_published()) try_connect(*session);
        if (state_.is_up()) follow_peer_ports(*session);
        if (state_.session() == session)
            sleep_until_event(state_.is_up() ? check_deadlines() : shm::longest_wait);
    }
    disconnect("");
    // The closing thread joins threads that may wait in this session.
    for (int i = 0; i < max_last_tries && end_last_session(); ++i)
        std::this_thread::sleep_for(retry_taken_side);
}

/// Wakes threads that still wait in the last session. Truncation of the segment's file may have cleared a word just
/// before a thread waited on it, so that the thread saw neither the stored value nor the wake-up.
bool PeerSupervisor::end_last_session() {
    const auto session = last_session_.lock();
    if (session) session->shut_down();
    return session != nullptr;
}

/// Also watches the peer's process, as soon as a peer has joined. If a process dies while no processor is free for
/// it, this shows when it has ended.
void PeerSupervisor::watch_peer(const LinkSession& session) {
    const auto& segment = *session.segment();
    if (segment.peer_state() == shm::PeerState::absent) return;
    peer_watched_ = true;
    const shm::ProcessIdentity process = segment.peer_process();
    const auto found = shm::find_process(process);
    if (found == shm::ProcessLookup::ended) settling_ = first_settling; // looks again soon
    if (found == shm::ProcessLookup::ended) return;
    // In another pid namespace, an unrelated process has this pid.
    const bool visible = found == shm::ProcessLookup::running;
    const auto refusal = visible ? watcher_.watch_process(process.pid) : std::nullopt;
    if (visible && !refusal) return;
    log::info("link '{}': process {} of the peer cannot be watched ({}); its end is noticed by the segment's "
              "lock alone",
              options_.name, process.pid,
              visible ? std::generic_category().message(*refusal) : "it is in another pid namespace");
}

/// Returns how soon to check again.
std::chrono::nanoseconds PeerSupervisor::check_deadlines() {
    std::vector<std::string> missed;
    const auto next_check = channels_.check_deadlines(missed);
    for (const auto& port : missed) handler_.deadline_missed(port);
    return next_check;
}

void PeerSupervisor::sleep_until_event(std::chrono::nanoseconds bound) {
    using Event = shm::Watcher::Event;
    const auto event = watcher_.wait(settling_.count() != 0 ? std::min(bound, settling_) : bound);
    if (event == Event::departed)
        settling_ = first_settling;
    else if (event == Event::none)
        settling_ = settling_ < max_settling ? 2 * settling_ : 0ns;
}

std::string PeerSupervisor::end_reason(const LinkSession& session) const {
    std::string reason = session.end_reason();
    if (reason.empty() && channels_.has_corrupt_ring())
        reason = "a ring of " + session.segment()->path() + " is damaged; the link is set up again";
    return reason;
}

void PeerSupervisor::rejoin() {
    try {
        begin_session();
        failed_rejoins_ = 0;
    } catch (const shm::SideTaken& taken) {
        // This process still holds the side: a thread works in the last session and releases the side soon.
        end_last_session();
        wait_to_rejoin(retry_taken_side, taken.what());
    } catch (const shm::Error& error) {
        wait_to_rejoin(retry_join, error.what());
    }
}

void PeerSupervisor::wait_to_rejoin(std::chrono::milliseconds delay, const std::string& reason) {
    if (++failed_rejoins_ % rejoins_per_log_line == 0) log::error("link '{}': {}", options_.name, reason);
    state_.wait_until_closing(delay);
}

void PeerSupervisor::try_connect(LinkSession& session) {
    std::string refusal;
    try {
        if (!chunks_suffice(session)) return; // one of the two sides joins a new segment
        auto peer = session.read_peer_table();
        if (!peer) return; // the peer notifies this side when it has finished
        refusal = bind_to_peer(session, peer->table);
    } catch (const std::runtime_error& error) { // LinkError, shm::Error, SignatureError: each has one line
        refusal = fmt::format("link '{}': {}", options_.name, error.what());
    }
    if (!refusal.empty()) {
        peer_refused_ = true;
        log::error(refusal);
        state_.set_refused(refusal);
        return;
    }
    joiner_.remember_peer_memory(session);
    state_.set_up();
    session.segment()->doorbell().ring(message_bit); // from now on, the notifier may check the rings
    handler_.link_state_changed(true);
    tasks_.post([this] { handler_.peer_connected(); });
}

/// Returns false if this session cannot carry the longest message that either side's user requested. The side that
/// created the rings must then join again with longer chunks. If it is this side, this function starts the new join.
bool PeerSupervisor::chunks_suffice(const LinkSession& session) {
    const auto limits = session.read_peer_limits();
    if (!limits) return true;
    if (joiner_.peer_needs_larger_chunks(*limits)) {
        disconnect("");
        return false;
    }
    return joiner_.peer_chunks_suffice(*limits);
}

/// Lets the handler check the peer's table, then binds the channels and opens the peer's call queue.
std::string PeerSupervisor::bind_to_peer(LinkSession& session, PortTable& peer) {
    std::string refusal = handler_.check_peer_ports(peer);
    if (!refusal.empty()) return refusal;
    channels_.bind(session.segment(), session_ports_, side_);
    channels_.bind(session.segment(), peer, session.peer_side());
    session.open_outgoing_calls();
    return "";
}

void PeerSupervisor::set_ports(PortTable own_ports) {
    {
        const std::lock_guard lock(next_ports_mutex_);
        next_ports_ = std::move(own_ports);
    }
    wake();
}

/// Publishes the table given to set_ports() in the current session. Without a session, the next one starts with it.
void PeerSupervisor::publish_new_ports(LinkSession* session) {
    {
        const std::lock_guard lock(next_ports_mutex_);
        if (!next_ports_) return;
        own_ports_ = std::move(*next_ports_);
        next_ports_.reset();
    }
    if (!session) return;
    number_rings();
    std::string left_out;
    try {
        PortTable ports = own_ports_;
        left_out = joiner_.add_missing_rings(*session, ports, own_ports_);
        session_ports_ = std::move(ports);
        // Before the peer is told, because the peer may read and write at once.
        if (state_.is_up()) channels_.bind(session->segment(), session_ports_, side_);
        session->publish_table(session_ports_);
    } catch (const std::runtime_error& error) { // LinkError, shm::Error, SignatureError: each has one line
        left_out = error.what();
    }
    report_left_out(left_out);
}

/// Lists what the peer does not get of this side's ports; logs it once in a session, because ports may change often.
void PeerSupervisor::report_left_out(const std::string& what) {
    left_out_.reset();
    if (what.empty()) return;
    const std::string line = fmt::format("link '{}': {}", options_.name, what);
    if (!std::exchange(left_out_reported_, true))
        log::error("{}; further ports that are not shared are not logged", line);
    left_out_.emplace(process::NoticeKind::setting, line);
}

/// Gives channels to ports that the peer has added, and other channels to ports with another type. Ports that the
/// peer has removed keep their idle channels, because they may be added again.
void PeerSupervisor::follow_peer_ports(LinkSession& session) {
    if (!session.peer_table_changed()) return;
    try {
        auto peer = session.read_peer_table();
        if (!peer) return; // the peer notifies this side when it has finished
        const std::string refusal = handler_.check_peer_ports(peer->table);
        if (!refusal.empty()) throw LinkError(refusal);
        channels_.bind(session.segment(), peer->table, session.peer_side());
    } catch (const std::runtime_error& error) {
        log::error("link '{}': the peer's new ports are not used: {}", options_.name, error.what());
        return;
    }
    // At most one task waits, even if the peer changes its ports often.
    if (ports_task_waits_.exchange(true)) return;
    tasks_.post([this] {
        ports_task_waits_ = false;
        handler_.peer_ports_changed();
    });
}

void PeerSupervisor::disconnect(const std::string& reason) {
    if (auto ended = state_.session()) last_session_ = ended;
    const bool was_up = state_.end_session();
    const std::uint64_t unread = channels_.unbind_all();
    if (was_up && !reason.empty())
        log::warn("link '{}' is down: {}{}", options_.name, reason,
                  unread == 0 ? "" : fmt::format("; {} messages under way are lost", unread));
    watcher_.stop_watching();
    if (!was_up || state_.is_closing()) return; // the closing thread knows that the link goes down
    handler_.link_state_changed(false);
    // The consequences of a departure, for example a deactivation, must not affect the requests of the next peer.
    departure_waits_ = true;
    tasks_.post([this] { handler_.peer_disconnected(); });
    tasks_.post([this] { // runs even if the handler has thrown
        departure_waits_ = false;
        wake();
    });
}

} // namespace tandem::link
