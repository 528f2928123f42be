// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/data/mirror_out_port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace tandem::adaptor {

MirrorOutPort::MirrorOutPort(link::Port peer, link::ChannelReader& channel, SetListener set_listener,
                             std::string convert)
    : peer_(std::move(peer)), channel_(channel), set_listener_(std::move(set_listener)),
      convert_(std::move(convert)) {}

MirrorOutPort::~MirrorOutPort() { clearConnection(); }

bool MirrorOutPort::checkType(DataPort* target) {
    auto* input = dynamic_cast<InputDataPortInterface*>(target);
    TypeCheck check;
    if (input)
        check = check_type(input->sample(), peer_, false, convert_);
    else
        check.error = fmt::format("port '{}': the target is not an input data port", peer_.name);
    std::string error = check.error;
    OutTap* tap = nullptr;
    if (error.empty()) {
        const std::lock_guard channel_lock(channel_.mutex());
        const std::lock_guard lock(listeners_mutex_);
        taps_.push_back(std::make_unique<OutTap>(*this, *input, std::move(check)));
        tap = taps_.back().get();
        has_other_targets_ = taps_.size() > 1;
    }
    // Called without a lock, because the target calls the source, which takes the locks.
    if (tap && input->addSource(tap) != OPROS_SUCCESS) {
        error = fmt::format("port '{}': the target takes no values from a bridge", peer_.name);
        remove(taps_.size() - 1);
    }
    type_error_ = std::move(error);
    record_refusal(type_error_);
    return type_error_.empty();
}

/// The host adds a connection right after it has had its target checked.
void MirrorOutPort::addConnection(IDataPortLink* connection) {
    OutputDataPortInterface::addConnection(connection);
    if (!taps_.empty() && !taps_.back()->connection) taps_.back()->connection = connection;
}

void MirrorOutPort::removeConnection(IDataPortLink* connection) {
    OutputDataPortInterface::removeConnection(connection);
    for (std::size_t i = taps_.size(); i > 0; --i)
        if (taps_[i - 1]->connection == connection || !taps_[i - 1]->connection) remove(i - 1);
}

void MirrorOutPort::clearConnection() {
    while (!taps_.empty()) remove(taps_.size() - 1);
}

/// Removes the source from its target first; after that, nobody uses the source.
void MirrorOutPort::remove(std::size_t index) {
    OutTap& tap = *taps_[index];
    tap.target().removeSource(&tap);
    set_listener(tap, nullptr);
    const std::lock_guard channel_lock(channel_.mutex());
    const std::lock_guard lock(listeners_mutex_);
    taps_.erase(taps_.begin() + static_cast<std::ptrdiff_t>(index));
    has_other_targets_ = taps_.size() > 1;
    set_channel_depth();
}

void MirrorOutPort::set_depth(OutTap& tap, std::size_t depth) {
    const std::lock_guard channel_lock(channel_.mutex());
    tap.depth_ = depth;
    set_channel_depth();
}

/// With the channel's lock held. The ring's reader skips messages for which no target's queue has room. Without a target the
/// depth stays unchanged, so that skipped messages stay counted.
void MirrorOutPort::set_channel_depth() {
    if (taps_.empty()) return;
    publish_room(nullptr);
    std::size_t depth = 0;
    for (const auto& tap : taps_) {
        if (tap->depth() == 0) return channel_.set_depth_locked(0);
        depth = std::max(depth, tap->depth());
    }
    channel_.set_depth_locked(depth);
}

void MirrorOutPort::publish_room(const OutTap* reader) {
    if (!has_other_targets_) return channel_.set_room_locked(std::nullopt);
    std::size_t room = std::numeric_limits<std::size_t>::max();
    for (const auto& tap : taps_) {
        const std::size_t kept = tap->kept() + (reader != nullptr && tap.get() != reader ? 1 : 0);
        room = std::min(room, tap->capacity() - std::min(kept, tap->capacity()));
    }
    channel_.set_room_locked(room);
}

void MirrorOutPort::keep_for_others(const OutTap& reader, std::span<const std::byte> bytes,
                                    std::uint64_t stamp) {
    for (auto& tap : taps_)
        if (tap.get() != &reader) tap->keep(bytes, stamp);
}

/// Calls the link only when the listener changes, because the link then calls the peer.
void MirrorOutPort::set_listener(OutTap& tap, DataPortListener* listener) {
    DataPortListener* told = nullptr;
    {
        const std::lock_guard lock(listeners_mutex_);
        tap.listener_ = listener;
        for (const auto& each : taps_)
            if (each->listener() && each->listener() != told) told = told ? this : each->listener();
        if (told == told_) return;
        told_ = told;
    }
    set_listener_(told);
}

void MirrorOutPort::arrived() {
    const std::lock_guard lock(listeners_mutex_);
    for (const auto& tap : taps_)
        if (tap->listener()) tap->listener()->arrived();
}

} // namespace tandem::adaptor
