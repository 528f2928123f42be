// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/data/out_tap.hpp"

#include "proxy/adaptor/data/mirror_out_port.hpp"
#include "proxy/wire/time.hpp"

#include <spdlog/spdlog.h>

namespace tandem::adaptor {
namespace {

// Messages that wait for a target while another one reads faster.
constexpr std::size_t max_kept = 64;

} // namespace

OutTap::OutTap(MirrorOutPort& port, InputDataPortInterface& target, TypeCheck check)
    : port_(port), target_(target), check_(std::move(check)) {}

void OutTap::keep(std::span<const std::byte> bytes, std::uint64_t stamp) {
    if (kept_.empty()) kept_.resize(max_kept);
    if (kept_count_ == max_kept) {
        if (dropped_.should_log())
            spdlog::warn("port '{}': one of its targets reads too slowly, {} messages dropped for it so far",
                         port_.peer().name, dropped_.count());
        first_kept_ = (first_kept_ + 1) % max_kept;
        --kept_count_;
    }
    KeptMessage& slot = kept_[(first_kept_ + kept_count_++) % max_kept];
    slot.bytes.assign(bytes.begin(), bytes.end());
    slot.stamp = stamp;
}

[[gnu::hot]] opros::archive::iarchive* OutTap::next() {
    // Held until done(): a rebind or another read would free the memory of the message.
    channel_lock_ = port_.channel().lock();
    for (;;) {
        if (kept_count_ > 0) [[unlikely]] {
            const KeptMessage& oldest = kept_[first_kept_];
            first_kept_ = (first_kept_ + 1) % max_kept;
            --kept_count_;
            if (auto* archive = open(oldest.bytes, oldest.stamp)) return archive;
            continue;
        }
        const auto record = port_.channel().read_locked();
        if (!record) {
            channel_lock_.unlock();
            return nullptr;
        }
        if (port_.has_other_targets()) port_.keep_for_others(*this, record->bytes, record->stamp_ns);
        if (auto* archive = open(record->bytes, record->stamp_ns)) return archive;
    }
}

opros::archive::iarchive* OutTap::again() {
    if (check_.conversion) return nullptr; // it would be counted
    channel_lock_ = port_.channel().lock(true);
    if (!channel_lock_) return nullptr;
    const auto record = port_.channel().last_locked();
    if (record) return open(record->bytes, record->stamp_ns);
    channel_lock_.unlock();
    return nullptr;
}

/// nullptr for a message that cannot be converted; it is dropped.
[[gnu::hot]] opros::archive::iarchive* OutTap::open(std::span<const std::byte> bytes, std::uint64_t stamp) {
    message_bytes_ = bytes.size();
    if (check_.conversion) [[unlikely]] {
        wire::CdrWriter out(converted_);
        if (!check_.conversion->run(wire::CdrReader(bytes), out)) {
            undecodable(check_.conversion->error());
            return nullptr;
        }
        bytes = out.written();
        port_.channel().count_converted_locked();
    }
    if (check_.set_time) stamp = wire::wall_clock_stamp();
    const wire::CdrReader reader(bytes);
    return check_.value_has_time ? &archive_.emplace(reader, stamp) : &archive_.emplace(reader);
}

[[gnu::hot]] void OutTap::done() {
    archive_.reset();
    channel_lock_.unlock();
}

bool OutTap::setListener(DataPortListener* listener) {
    port_.set_listener(*this, listener);
    return true;
}

void OutTap::undecodable(const std::string& why) {
    port_.channel().count_undecodable_locked(); // next() has the lock
    // Connected types match, so this happens only if the peer is broken; then it may happen in every cycle.
    if (undecodable_.should_log())
        spdlog::error("port '{}': a message of {} bytes does not decode ({}) and is dropped, {} so far",
                      port_.peer().name, message_bytes_, why, undecodable_.count());
}

} // namespace tandem::adaptor
