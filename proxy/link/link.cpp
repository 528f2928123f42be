// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/link.hpp"

#include "proxy/link/link_session.hpp"
#include "shm/segment/truncation_guard.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>

namespace tandem::link {
namespace {

using namespace std::chrono_literals;

// Part of what both halves must agree on; raise it when the table, the requests or the records change.
constexpr std::uint64_t contract = 0x7461'6e64'656d'0002; // "tandem", 2

constexpr auto watch_up = 10ms; // also the beat of the heart
constexpr auto watch_down =
    3ms; // a peer that comes is noticed by the watcher; this is for what it cannot see
constexpr auto retry_side = 1ms;
constexpr auto retry_join = 10ms;

bool is_data(PortKind kind) { return kind == PortKind::data_out || kind == PortKind::data_in; }

} // namespace

Link::Link(shm::Side side, LinkOptions options, PortTable own, LinkHandler& handler)
    : side_(side), options_(std::move(options)), own_(std::move(own)), handler_(handler),
      watcher_(options_.name), large_bytes_(options_.rings.large_bytes) {}

Link::~Link() { close(); }

void Link::open() {
    shm::install_truncation_guard();
    session_ = join();
    link_thread_ = std::thread([this] { run_link(); });
    task_thread_ = std::thread([this] { run_tasks(); });
    const std::lock_guard lock(mutex_);
    start_worker();
}

void Link::close() {
    if (stopping_.exchange(true)) return;
    watcher_.interrupt();
    { // under the mutex, so that nobody misses it between looking and waiting
        const std::lock_guard lock(mutex_);
        if (session_) session_->incoming.interrupt();
        changed_.notify_all();
    }
    if (link_thread_.joinable()) link_thread_.join();
    if (task_thread_.joinable()) task_thread_.join();
    for (auto& worker : workers_) worker.join();
    session_.reset();
}

void Link::wait_until_up(std::chrono::milliseconds bound, const std::string& peer) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, bound, [this] { return up() || !refusal_.empty() || stopping_; });
    if (up()) return;
    if (!refusal_.empty()) throw LinkError(refusal_);
    throw LinkError(
        fmt::format("link '{}': {} did not come within {} s; start it with link={}, or allow more time",
                    options_.name, peer, static_cast<double>(bound.count()) / 1000.0, options_.name));
}

std::shared_ptr<Session> Link::session() const {
    const std::lock_guard lock(mutex_);
    return session_;
}

ChannelWriter& Link::writer(const std::string& port) {
    const std::lock_guard lock(mutex_);
    return writers_.try_emplace(port, port).first->second;
}

ChannelReader& Link::reader(const std::string& port) {
    const std::lock_guard lock(mutex_);
    return readers_[port];
}

// ---- the link thread: joins, watches, brings up and takes down

std::shared_ptr<Session> Link::join() const {
    RingSizes sizes = options_.rings;
    sizes.large_bytes = large_bytes_;
    const RingPlan plan = plan_rings(own_, side_, sizes);
    check_available_memory(plan, sizes);
    shm::JoinOptions join_options;
    join_options.arena_bytes = options_.segment_bytes;
    join_options.loan_bytes = plan.loan_bytes;
    join_options.peer_loan_bytes = peer_loan_bytes_;
    join_options.sparse = true; // most ports whose messages may be long never send one that is
    join_options.contract = contract;
    std::shared_ptr<shm::Segment> segment = shm::Segment::join(options_.name, side_, join_options);
    const auto peer = shm::other(side_);
    for (const auto& ring : plan.rings) segment->add_ring(ring_name(ring.port), ring.options);
    shm::CallQueueOptions queue;
    queue.callers = peer;
    const auto calls = segment->add_call_queue(calls_name, queue);
    const auto table = encode(own_);
    std::memcpy(segment->add_blob(table_name, table.size()).data(), table.data(), table.size());
    const LargeMessageLimits large{options_.rings.large_bytes,
                                   plan.rings.empty() ? max_large_bytes : large_bytes_};
    std::memcpy(segment->add_blob(large_name, sizeof large).data(), &large, sizeof large);
    segment->publish();
    return std::make_shared<Session>(segment, calls, options_.wait);
}

void Link::run_link() {
    while (!stopping_) {
        const auto now = session();
        if (!now) {
            rejoin();
            continue;
        }
        now->segment->heartbeat();
        if (const std::string why = end_reason(*now); !why.empty()) {
            disconnect(why);
            continue;
        }
        if (!up() && !now->refused && now->segment->peer_published()) try_connect(now);
        watcher_.wait(up() ? watch_up : watch_down);
    }
    disconnect("");
}

/// Empty while the session goes on. What was cut reads as zeros, so that is looked at first.
std::string Link::end_reason(const Session& session) {
    const shm::Segment& segment = *session.segment;
    if (segment.truncated())
        return segment.path() + " was truncated by another process; the link starts afresh";
    if (has_corrupt_ring()) return "a ring of " + segment.path() + " is damaged; the link starts afresh";
    if (segment.peer() == shm::PeerState::dead) return "the peer process has gone";
    return segment.superseded() ? segment.path() + " was removed or superseded; the link starts afresh" : "";
}

/// Words in a ring that cannot be: somebody else has written there, and nothing more would come through it.
bool Link::has_corrupt_ring() {
    const std::lock_guard lock(mutex_);
    const auto corrupt = [](const auto& channel) { return channel.second.corrupt(); };
    return std::any_of(writers_.begin(), writers_.end(), corrupt) ||
           std::any_of(readers_.begin(), readers_.end(), corrupt);
}

void Link::rejoin() {
    try {
        auto joined = join();
        const std::lock_guard lock(mutex_);
        session_ = std::move(joined);
        changed_.notify_all();
        refused_joins_ = 0;
    } catch (const shm::SideTaken& taken) { // by our own past: threads are leaving the last session right now
        wait_to_rejoin(retry_side, taken.what());
    } catch (const shm::Error& error) {
        wait_to_rejoin(retry_join, error.what());
    }
}

void Link::wait_to_rejoin(std::chrono::milliseconds bound, const std::string& why) {
    // Not for the first moments, which pass by themselves, nor again and again.
    if (++refused_joins_ % 100 == 0) spdlog::error("link '{}': {}", options_.name, why);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, bound, [this] { return stopping_.load(); });
}

/// Whether a half asks for longer messages than the other one has laid out chunks for; that one then joins
/// anew.
bool Link::peer_needs_larger_chunks(const Session& session) {
    const auto bytes = session.segment->copy_blob(shm::other(side_), large_name);
    LargeMessageLimits theirs{};
    if (!bytes || bytes->size() != sizeof theirs) return false;
    std::memcpy(&theirs, bytes->data(), sizeof theirs);
    const bool more = theirs.asked > large_bytes_ && theirs.asked <= max_large_bytes;
    if (more) large_bytes_ = theirs.asked;
    const bool lays_out = std::any_of(own_.ports.begin(), own_.ports.end(),
                                      [](const Port& port) { return is_data(port.kind); });
    if (more && lays_out) disconnect("");
    return (more && lays_out) || theirs.laid_out < options_.rings.large_bytes;
}

void Link::try_connect(const std::shared_ptr<Session>& session) {
    const auto peer = shm::other(side_);
    std::string refusal;
    try {
        if (peer_needs_larger_chunks(*session)) return;
        const auto bytes = session->segment->copy_blob(peer, table_name);
        const auto calls = session->segment->find_call_queue(peer, calls_name);
        if (!bytes || !calls) throw LinkError("the peer published no port table");
        const PortTable table = decode_port_table(*bytes);
        refusal = handler_.check_peer_ports(table);
        if (refusal.empty()) {
            bind(*session, own_, true);
            bind(*session, table, false);
            const std::lock_guard lock(mutex_);
            session->outgoing.emplace(*calls, options_.wait);
        }
    } catch (const std::runtime_error& error) { // LinkError, shm::Error, SignatureError: all of them one line
        refusal = fmt::format("link '{}': {}", options_.name, error.what());
    }
    session->refused = !refusal.empty();
    if (!session->refused) {
        const auto theirs = session->segment->arena_bytes(peer);
        peer_loan_bytes_ = theirs - std::min(theirs, options_.segment_bytes);
        up_.store(true, std::memory_order_release);
        handler_.link_state_changed(true);
        post([this] { handler_.peer_connected(); });
    } else {
        spdlog::error(refusal);
    }
    const std::lock_guard lock(mutex_);
    refusal_ = refusal;
    changed_.notify_all();
}

void Link::bind(Session& session, const PortTable& table, bool own) {
    const auto peer = shm::other(side_);
    for (const Port& port : table.ports) {
        if (!is_data(port.kind)) continue;
        const auto ring = session.segment->find_ring(own ? side_ : peer, ring_name(port.name));
        if (!ring) throw LinkError(fmt::format("port '{}' is in the table but has no ring", port.name));
        if ((port.kind == PortKind::data_out) == own)
            writer(port.name).bind(session.segment, shm::RingWriter(*ring));
        else
            reader(port.name).bind(session.segment, shm::RingReader(*ring));
    }
}

void Link::disconnect(const std::string& why) {
    const bool was_up = up_.exchange(false);
    if (was_up && !why.empty()) spdlog::warn("link '{}' is down: {}", options_.name, why);
    {
        const std::lock_guard lock(mutex_);
        for (auto& [name, writer] : writers_) writer.unbind();
        for (auto& [name, reader] : readers_) reader.unbind();
        if (session_) session_->incoming.shut_down();
        if (session_ && session_->outgoing) session_->outgoing->shut_down();
        session_.reset();
        refusal_.clear();
    }
    if (!was_up || stopping_) return; // who closes the link itself need not be told
    handler_.link_state_changed(false);
    post([this] { handler_.peer_disconnected(); });
}

// ---- calls of the peer

void Link::start_worker() {
    workers_.emplace_back([this] { run_worker(); });
}

void Link::run_worker() {
    while (!stopping_) {
        std::shared_ptr<Session> now;
        {
            std::unique_lock lock(mutex_);
            ++idle_workers_;
            changed_.wait_for(lock, 100ms, [this] { return session_ || stopping_; });
            now = session_;
        }
        auto call = now ? now->incoming.take(100ms) : std::nullopt;
        {
            const std::lock_guard lock(mutex_);
            --idle_workers_;
            // Somebody must stay free for the calls that this one leads the peer to make in turn.
            if (call && idle_workers_ == 0 && workers_.size() < options_.max_workers && !stopping_)
                start_worker();
        }
        now.reset(); // a call may take long; the session must be able to end meanwhile
        if (call) serve(std::move(*call));
    }
}

void Link::serve(shm::IncomingCall call) {
    { // The peer may be up a moment before us, and what it asks for may call it in turn.
        watcher_.interrupt();
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, 1s, [this] { return up() || !refusal_.empty() || !session_ || stopping_; });
    }
    Reply reply = Reply::failure(CallStatus::bad_arguments, "the request is malformed");
    try {
        if (const auto request = decode_request(call.arguments())) reply = handler_.serve(*request);
    } catch (const std::exception& error) { // out of memory, say: the caller hears of it, the worker lives on
        reply = Reply::failure(CallStatus::exception, error.what());
    }
    call.reply(reply.status, reply.bytes);
}

Reply Link::call(const Request& request, std::chrono::milliseconds timeout) {
    std::shared_ptr<Session> now; // keeps the segment mapped during the call
    shm::CallClient* client = nullptr;
    {
        const std::lock_guard lock(mutex_);
        now = session_;
        if (now && now->outgoing && up()) client = &*now->outgoing;
    }
    if (!client) return Reply::failure(CallStatus::peer_died, "the peer is not there");
    thread_local std::vector<std::byte> slot;
    encode(request, slot);
    auto reply = client->call(0, slot, timeout);
    return {reply.status, std::move(reply.bytes)};
}

// ---- the task thread: what may wait, outside of the link's own threads

void Link::post(std::function<void()> task) {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    changed_.notify_all();
}

void Link::run_tasks() {
    while (!stopping_) {
        std::function<void()> task;
        {
            std::unique_lock lock(mutex_);
            changed_.wait_for(lock, 1s, [this] { return !tasks_.empty() || stopping_; });
            if (stopping_ || tasks_.empty()) continue;
            task = std::move(tasks_.front());
            tasks_.pop_front();
        }
        try {
            task();
        } catch (const std::exception& error) {
            spdlog::error("link '{}': {}", options_.name, error.what());
        }
    }
}

} // namespace tandem::link
