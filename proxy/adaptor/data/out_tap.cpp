// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/data/out_tap.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/archive/pictures.hpp"
#include "proxy/adaptor/data/mirror_out_port.hpp"
#include "proxy/wire/time.hpp"

#include <algorithm>

namespace tandem::adaptor {
namespace {

// The most messages kept for a target with an unlimited queue while another target reads faster.
constexpr std::size_t max_kept = 64;

} // namespace

OutTap::OutTap(MirrorOutPort& port, InputDataPortInterface& target, TypeCheck check)
    : port_(port), target_(target), check_(std::move(check)),
      plain_(!check_.conversion && !check_.value_has_time), checks_(check_.conversion || check_.pictures) {}

std::size_t OutTap::capacity() const { return depth_ != 0 ? depth_ : max_kept; }

void OutTap::keep(std::span<const std::byte> bytes, std::uint64_t stamp) {
    while (kept_count_ >= capacity()) {
        count_dropped();
        forget_oldest_kept();
    }
    if (kept_count_ == kept_.size()) {
        std::rotate(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(first_kept_), kept_.end());
        first_kept_ = 0;
        kept_.resize(std::max<std::size_t>(2 * kept_.size(), 4));
    }
    KeptMessage& slot = kept_[(first_kept_ + kept_count_++) % kept_.size()];
    slot.bytes.assign(bytes.begin(), bytes.end());
    slot.stamp = stamp;
}

void OutTap::forget_oldest_kept() {
    first_kept_ = (first_kept_ + 1) % kept_.size();
    --kept_count_;
}

/// Counts a message that only this target has lost. A target that wants only the newest message misses nothing.
void OutTap::count_dropped() {
    if (depth_ == 1) return;
    port_.channel().count_discarded_locked();
    if (dropped_.should_log())
        log::warn("port '{}': one of its targets reads too slowly, {} messages dropped for it so far",
                  port_.peer().name, dropped_.count());
}

/// With the channel's lock held. If the port has several targets, drops the messages for which this target's queue has no room.
void OutTap::skip_beyond_depth() {
    while (depth_ != 0 && kept_count_ + port_.channel().waiting_locked() > depth_) {
        if (kept_count_ != 0) {
            forget_oldest_kept();
        } else {
            const shm::Record* const record = read_for_all();
            if (!record) return;
            port_.keep_for_others(*this, snapshot_.of(*record), record->stamp_ns);
        }
        count_dropped();
    }
}

/// Returns false for a message that cannot be converted. The message is dropped.
inline bool OutTap::decode(std::span<const std::byte> bytes, std::uint64_t stamp, opros_any* value) {
    message_bytes_ = bytes.size();
    opros_any::holder_base* const held = value ? value->held() : nullptr;
    if (!held) [[unlikely]]
        return true;
    const std::size_t element_bytes = held->elementBytes();
    if (element_bytes == 0 || !plain_) return decode_by_archive(bytes, stamp, *value);
    wire::CdrReader reader(bytes);
    const auto elements = reader.get_sequence(element_bytes, element_bytes);
    if (!reader.ok()) [[unlikely]]
        throw opros::archive::archive_type_exception();
    auto memory = held->elements(); // most values have the length of the last one
    if (memory.bytes != elements.size()) [[unlikely]]
        memory = held->resize(elements.size() / element_bytes);
    wire::copy_block(memory.begin, elements.data(), elements.size());
    return true;
}

// Called in rehearsals only. Does not run conversions, because they are counted.
bool OutTap::again(opros_any& value) { return !check_.conversion && take(&value); }

bool OutTap::take(opros_any* value) {
    auto& channel = port_.channel();
    if (!channel.mutex().lock_unless_rehearsing()) return false;
    const rt::ShortLock lock(channel.mutex(), std::adopt_lock); // also keeps the channel bound
    if ((port_.has_other_targets() || kept_count_ > 0) && !rt::rehearsing()) [[unlikely]]
        return read_beside_others(value);
    for (;;) {
        const shm::Record* const record = channel.read_locked();
        if (!record) return false;
        const auto bytes = checks_ ? snapshot_.of(*record) : record->bytes;
        if (decode(bytes, record->stamp_ns, value)) [[likely]]
            return true;
        if (rt::rehearsing()) return false;
    }
}

/// With the channel's lock held. Reads for a port that has or had other targets.
bool OutTap::read_beside_others(opros_any* value) {
    for (;;) {
        if (port_.has_other_targets()) skip_beyond_depth();
        if (kept_count_ > 0) {
            if (take_kept(value)) return true;
            continue;
        }
        const shm::Record* const record = read_for_all();
        if (!record) return false;
        const auto bytes = snapshot_.of(*record);
        port_.keep_for_others(*this, bytes, record->stamp_ns);
        if (decode(bytes, record->stamp_ns, value)) return true;
    }
}

/// Reads a message and copies it for the other targets. A waiting sender must not use the room that their copies need.
const shm::Record* OutTap::read_for_all() {
    auto& channel = port_.channel();
    const bool waits = channel.sender_waits_locked();
    if (waits) port_.publish_room(this);
    const shm::Record* const record = channel.read_locked();
    if (waits && !record) port_.publish_room(nullptr);
    return record;
}

/// The messages in the ring are for all targets, including this one.
long OutTap::waiting() {
    const rt::ShortLock lock(port_.channel().mutex());
    const std::size_t waiting = kept_count_ + port_.channel().waiting_locked();
    return static_cast<long>(depth_ != 0 ? std::min(waiting, depth_) : waiting);
}

void OutTap::setDepth(std::size_t values) { port_.set_depth(*this, values); }

bool OutTap::waitsForRoom() {
    const rt::ShortLock lock(port_.channel().mutex());
    return port_.channel().sender_waits_locked();
}

void OutTap::discarded() {
    const rt::ShortLock lock(port_.channel().mutex());
    count_dropped();
}

bool OutTap::take_kept(opros_any* value) {
    const KeptMessage& oldest = kept_[first_kept_];
    forget_oldest_kept();
    port_.publish_room(nullptr); // also without a peer: the next peer finds the message in its ring
    return decode(oldest.bytes, oldest.stamp, value);
}

bool OutTap::decode_by_archive(std::span<const std::byte> bytes, std::uint64_t stamp, opros_any& value) {
    if (check_.conversion) [[unlikely]] {
        const auto converted = convert(bytes);
        if (!converted) return false;
        bytes = *converted;
    }
    if (check_.pictures) [[unlikely]]
        if (const auto why = picture_error(*check_.pictures, wire::CdrReader(bytes), PictureBytes::exact);
            !why.empty()) {
            report_undecodable(why);
            return false;
        }
    if (check_.conversion) [[unlikely]]
        port_.channel().count_converted_locked();
    if (check_.set_time) stamp = wire::wall_clock_stamp();
    CdrIarchive archive(wire::CdrReader(bytes), stamp, check_.value_has_time);
    value.decode(archive);
    return true;
}

std::optional<std::span<const std::byte>> OutTap::convert(std::span<const std::byte> bytes) {
    wire::CdrWriter out(converted_);
    if (!check_.conversion->run(wire::CdrReader(bytes), out)) {
        report_undecodable(check_.conversion->error());
        return std::nullopt;
    }
    return out.written();
}

bool OutTap::setListener(DataPortListener* listener) {
    port_.set_listener(*this, listener);
    return true;
}

void OutTap::undecodable(const std::string& why) {
    const rt::ShortLock lock(port_.channel().mutex());
    report_undecodable(why);
}

/// With the channel's lock held.
void OutTap::report_undecodable(const std::string& why) {
    port_.channel().count_undecodable_locked();
    // Connected types match, so this happens only if the peer is broken; then it may happen in every cycle.
    if (undecodable_.should_log())
        log::error("port '{}': a message of {} bytes does not decode ({}) and is dropped, {} so far",
                   port_.peer().name, message_bytes_, why, undecodable_.count());
}

} // namespace tandem::adaptor
