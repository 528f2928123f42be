// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/peer_supervisor.hpp"

#include "proxy/link/protocol/link_error.hpp"

#include <spdlog/spdlog.h>

namespace tandem::link {
namespace {

using namespace std::chrono_literals;

// While the link is up: also the period of the heartbeat.
constexpr auto watch_period_up = 10ms;
// While it is down: the watcher wakes the thread when a peer joins; this period covers what it cannot see.
constexpr auto watch_period_down = 3ms;
constexpr auto retry_taken_side = 1ms;
constexpr auto retry_join = 10ms;
// Failures to join pass by themselves during a restart: only a lasting one is logged, once per so many tries.
constexpr unsigned rejoins_per_log_line = 100;

} // namespace

PeerSupervisor::PeerSupervisor(shm::Side side, const LinkOptions& options, const PortTable& own_ports,
                               LinkHandler& handler, LinkState& state, ChannelTable& channels,
                               TaskQueue& tasks)
    : side_(side), options_(options), own_ports_(own_ports), handler_(handler), state_(state),
      channels_(channels), tasks_(tasks), watcher_(options.name), joiner_(side, options, own_ports) {}

void PeerSupervisor::start() {
    state_.start_session(joiner_.join());
    thread_ = std::thread([this] { run(); });
}

void PeerSupervisor::stop() {
    wake();
    if (thread_.joinable()) thread_.join();
}

void PeerSupervisor::run() {
    while (!state_.is_closing()) {
        const auto session = state_.session();
        if (!session) {
            rejoin();
            continue;
        }
        session->segment()->heartbeat();
        if (const std::string reason = end_reason(*session); !reason.empty()) {
            disconnect(reason);
            continue;
        }
        if (!state_.is_up() && !peer_refused_ && session->segment()->peer_published()) try_connect(*session);
        if (state_.is_up()) channels_.check_deadlines();
        watcher_.wait(state_.is_up() ? watch_period_up : watch_period_down);
    }
    disconnect("");
}

std::string PeerSupervisor::end_reason(const LinkSession& session) const {
    std::string reason = session.end_reason();
    if (reason.empty() && channels_.has_corrupt_ring())
        reason = "a ring of " + session.segment()->path() + " is damaged; the link starts afresh";
    return reason;
}

void PeerSupervisor::rejoin() {
    try {
        state_.start_session(joiner_.join());
        peer_refused_ = false;
        failed_rejoins_ = 0;
    } catch (const shm::SideTaken& taken) {
        // By this process itself: some thread still works in the last session and gives the side back soon.
        wait_to_rejoin(retry_taken_side, taken.what());
    } catch (const shm::Error& error) {
        wait_to_rejoin(retry_join, error.what());
    }
}

void PeerSupervisor::wait_to_rejoin(std::chrono::milliseconds delay, const std::string& reason) {
    if (++failed_rejoins_ % rejoins_per_log_line == 0) spdlog::error("link '{}': {}", options_.name, reason);
    state_.wait_until_closing(delay);
}

void PeerSupervisor::try_connect(LinkSession& session) {
    std::string refusal;
    try {
        if (!chunks_suffice(session)) return; // one of the two sides joins a new segment
        refusal = bind_to_peer(session);
    } catch (const std::runtime_error& error) { // LinkError, shm::Error, SignatureError: each is one line
        refusal = fmt::format("link '{}': {}", options_.name, error.what());
    }
    if (!refusal.empty()) {
        peer_refused_ = true;
        spdlog::error(refusal);
        state_.set_refused(refusal);
        return;
    }
    joiner_.remember_peer_memory(session);
    state_.set_up();
    handler_.link_state_changed(true);
    tasks_.post([this] { handler_.peer_connected(); });
}

/// False if this session cannot carry the longest message that either side's user asked for. Then the side
/// that created the rings has to join anew with longer chunks, which this function starts if it is this side.
bool PeerSupervisor::chunks_suffice(const LinkSession& session) {
    const auto limits = session.read_peer_limits();
    if (!limits) return true;
    if (joiner_.peer_needs_larger_chunks(*limits)) {
        disconnect("");
        return false;
    }
    return joiner_.peer_chunks_suffice(*limits);
}

/// Has the handler check the peer's table, then binds the channels and opens the peer's call queue.
std::string PeerSupervisor::bind_to_peer(LinkSession& session) {
    PortTable peer_ports = session.read_peer_table();
    std::string refusal = handler_.check_peer_ports(peer_ports);
    if (!refusal.empty()) return refusal;
    channels_.bind(session.segment(), own_ports_, side_);
    channels_.bind(session.segment(), peer_ports, session.peer_side());
    session.open_outgoing_calls();
    return "";
}

void PeerSupervisor::disconnect(const std::string& reason) {
    const bool was_up = state_.end_session();
    const std::uint64_t unread = channels_.unbind_all();
    if (was_up && !reason.empty())
        spdlog::warn("link '{}' is down: {}{}", options_.name, reason,
                     unread == 0 ? "" : fmt::format("; {} messages under way are lost", unread));
    if (!was_up || state_.is_closing()) return; // whoever closes the link knows that it goes down
    handler_.link_state_changed(false);
    tasks_.post([this] { handler_.peer_disconnected(); });
}

} // namespace tandem::link
