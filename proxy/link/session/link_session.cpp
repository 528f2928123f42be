// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/session/link_session.hpp"

#include "host/call/thread_calls.hpp"
#include "proxy/link/protocol/link_error.hpp"

#include <fmt/format.h>

#include <cstring>

namespace tandem::link {

namespace {

/// Returns the control of the component's handle for the calls of this thread.
shm::CallControl control_of_thread() {
    const auto* handle = call::handle_of_thread();
    if (!handle) return {};
    return {&(*handle)->cancelled, &(*handle)->progress, (*handle)->max_ns};
}

} // namespace

LinkSession::LinkSession(std::shared_ptr<shm::Segment> segment, const shm::CallQueueHandle& incoming_calls,
                         const shm::WaitOptions& wait)
    : segment_(std::move(segment)), wait_(wait), incoming_calls_(incoming_calls, wait) {}

std::string LinkSession::end_reason() const {
    // Must come first: a truncated file reads as zeros, which the other checks would misinterpret.
    if (segment_->truncated())
        return segment_->path() + " was truncated by another process; the link is set up again";
    if (segment_->peer_state() == shm::PeerState::dead) return "the peer process has gone";
    if (segment_->superseded())
        return segment_->path() + " was removed or superseded; the link is set up again";
    return "";
}

std::optional<PublishedTable> LinkSession::read_peer_table() {
    const auto memory = segment_->find_blob(peer_side(), table_name);
    const auto copy = segment_->copy_blob(peer_side(), table_name);
    if (!memory || !copy) throw LinkError("the peer published no port table");
    auto published = read_published_table(*copy);
    if (!published) return std::nullopt;
    peer_table_ = *memory;
    peer_version_ = published->version;
    return published;
}

bool LinkSession::peer_table_changed() const { return published_version(peer_table_) != peer_version_; }

void LinkSession::publish_table(const PortTable& table) {
    const auto memory = segment_->find_blob(segment_->side(), table_name);
    const auto encoded = encode(table);
    if (!memory || !write_published_table(*memory, encoded, own_version_ + 1))
        throw LinkError(
            fmt::format("the peer does not get the changed ports: their table of {} bytes does not fit "
                        "into {}; restart the other host, for which the table is created again",
                        encoded.size(), segment_->path()));
    ++own_version_;
    segment_->publish();
}

std::optional<LargeMessageLimits> LinkSession::read_peer_limits() const {
    const auto bytes = segment_->copy_blob(peer_side(), limits_name);
    LargeMessageLimits limits{};
    if (!bytes || bytes->size() != sizeof limits) return std::nullopt;
    std::memcpy(&limits, bytes->data(), sizeof limits);
    return limits;
}

void LinkSession::open_outgoing_calls() {
    const auto queue = segment_->find_call_queue(peer_side(), calls_name);
    if (!queue) throw LinkError("the peer published no call queue");
    outgoing_calls_.emplace(*queue, wait_, control_of_thread);
}

void LinkSession::interrupt() {
    incoming_calls_.end_all_waits();
    segment_->doorbell().interrupt();
    segment_->end_sleeps();
}

void LinkSession::shut_down() {
    incoming_calls_.shut_down();
    if (outgoing_calls_) outgoing_calls_->shut_down();
    segment_->doorbell().interrupt();
    segment_->end_sleeps();
}

} // namespace tandem::link
