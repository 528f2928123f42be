// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel/channel.hpp"

#include "host/log/log.hpp"
#include "host/rt/crossings.hpp"
#include "shm/segment/segment_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <thread>
#include <utility>

namespace tandem::link {
namespace {

/// Returns the number of waiting messages in a ring that has ever been read. An unconnected port loses nothing.
std::uint64_t unread_in(const shm::RingCounters& counters) {
    return counters.received == 0 ? 0 : counters.waiting();
}

} // namespace

// ---- ChannelWriter; the private functions require mutex_

/// Call it after publishing the message, so that the thread that the doorbell wakes finds it.
inline void ChannelWriter::ring_peer() {
    if (peer_listens_) peer_slept_ = bound_->segment->ring_peer(message_bit);
}

/// Call it before publishing a message. If the peer was asleep at the last message, there is time to measure the age
/// of some messages.
inline void ChannelWriter::choose_sample() {
    if (peer_slept_) bound_->ring.sample_next_sometimes();
}

bool ChannelWriter::publish_chunk(std::span<const std::byte> message, std::uint64_t stamp) {
    if (has_policy_ && !follow_policy(message, stamp)) {
        bound_->ring.cancel_reservation();
        return false;
    }
    choose_sample();
    if (!bound_->ring.commit(message.size(), stamp)) return report_damage();
    ring_peer();
    return true;
}

bool ChannelWriter::publish_attending(std::size_t bytes, std::uint64_t stamp) {
    if (rt::rehearsing()) {
        bound_->ring.rehearse_publish(bytes);
        rt::note_crossings(bound_->ring.sent());
        return true;
    }
    const auto message = bound_->ring.scratch().first(bytes);
    if (has_policy_ && !follow_policy(message, stamp)) return false;
    choose_sample();
    if (!bound_->ring.publish(bytes, stamp)) return report_refusal(bytes);
    ring_peer();
    return true;
}

/// Keeps the message and waits for room, as the policy requires. Returns false if there is no room and the message is
/// dropped.
bool ChannelWriter::follow_policy(std::span<const std::byte> message, std::uint64_t stamp) {
    if (policy_.keep_last) {
        last_.assign(message.begin(), message.end());
        last_stamp_ = stamp;
        has_last_ = true;
    }
    if (policy_.holds_back() && !make_room(message.size())) return report_damage();
    if (room_ != 0) --room_; // for this message
    return true;
}

/// Returns false if the message is dropped, counted and logged. Otherwise the ring drops its oldest messages if
/// necessary.
bool ChannelWriter::make_room(std::size_t bytes) {
    if (policy_.wait.count() != 0)
        return wait_for_room(bytes) ||
               drop_for_room(fmt::format("waited {} ms for room", policy_.wait.count()));
    return is_below_depth() || drop_for_room("finds the queue full");
}

/// Returns true if the reader would not skip another message for this one. Reads the reader's counters only when the
/// room that they showed at the last check is used up.
bool ChannelWriter::is_below_depth() {
    if (room_ == 0) {
        const auto counters = bound_->ring.counters();
        const std::uint64_t depth = policy_.length != 0 ? policy_.length : counters.depth;
        const auto limit = bound_->ring.published_room();
        if (!limit && depth == 0) return true; // the depth may change
        const std::uint64_t waiting = counters.waiting(), room = limit.value_or(depth);
        room_ = waiting < room ? room - waiting : 0;
    }
    return room_ != 0;
}

/// Returns false if another message would displace one only from the queue of a target that is slower than others.
bool ChannelWriter::is_full_for_all() {
    const auto counters = bound_->ring.counters();
    return !bound_->ring.published_room() || (counters.depth != 0 && counters.waiting() >= counters.depth);
}

/// Always returns false.
bool ChannelWriter::drop_for_room(const std::string& why) {
    bound_->ring.refuse();
    if (no_room_.should_log())
        log::warn("port '{}': the reader is too slow: a message {} and is dropped, {} so far", port_, why,
                  no_room_.count());
    return false;
}

/// Polls, because a reader does not notify the writer: that would cost every reader a system call. Makes system calls
/// only while the ring is full. If one of several targets reads nothing, only one message waits until the time limit.
bool ChannelWriter::wait_for_room(std::size_t bytes) {
    constexpr auto pause = std::chrono::microseconds(50);
    const auto deadline = std::chrono::steady_clock::now() + policy_.wait;
    for (bool has_room = false; !(has_room = bound_->ring.has_room(bytes)) || !is_below_depth();) {
        if (bound_->ring.corrupt()) return false;
        if (gave_up_ || std::chrono::steady_clock::now() >= deadline)
            return gave_up_ = has_room && !is_full_for_all();
        std::this_thread::sleep_for(pause);
    }
    gave_up_ = false;
    return true;
}

void ChannelWriter::set_policy(const PortPolicy& policy) {
    const std::lock_guard lock(mutex_);
    policy_ = policy;
    has_policy_ = policy.keep_last || policy.holds_back();
    attends_ = has_policy_ || peer_listens_;
    if (bound_) bound_->ring.set_waits_for_room(policy.wait.count() != 0);
}

/// Sends the kept message to a peer that has connected since.
void ChannelWriter::send_last_again() {
    if (!has_last_ || bound_->ring.counters().sent != 0) return;
    const auto room = bound_->ring.reserve(last_.size());
    if (room.data() == nullptr) return;
    std::copy(last_.begin(), last_.end(), room.begin());
    bound_->ring.commit(last_.size(), last_stamp_);
}

/// Logs why the ring refused a message of this length; the ring itself only counts it. Rings that drop the oldest
/// message refuse for two reasons: the message is longer than a chunk, or /dev/shm has no memory left for the chunk.
/// Always returns false.
bool ChannelWriter::report_refusal(std::size_t bytes) {
    const std::size_t limit = bound_->ring.max_message();
    if (bytes > limit) {
        // Logs once per limit, because a component sends such messages in every cycle.
        if (limit != std::exchange(reported_limit_, limit))
            log::error("port '{}': a message of {} bytes is longer than {} and is dropped, like each longer "
                       "one; raise large_kib to {} or more",
                       port_, bytes, limit, (bytes + 1023) / 1024);
    } else if (!bound_->ring.corrupt() && no_memory_.should_log()) {
        log::error("port '{}': a message of {} bytes does not fit into the free memory of {} and is dropped, "
                   "{} so far; {} "
                   "bytes are available: free some or enlarge it",
                   port_, bytes, shm::shm_directory, no_memory_.count(), shm::available_bytes().value_or(0));
    }
    return report_damage();
}

/// Always returns false, because the message was not sent.
bool ChannelWriter::report_damage() {
    if (bound_->ring.corrupt()) wake_supervisor_();
    return false;
}

/// Takes the lock. Each message is therefore either sent before, and the peer finds it when it checks afterwards, or
/// rings.
void ChannelWriter::set_peer_listens(bool listens) {
    const std::lock_guard lock(mutex_);
    peer_listens_ = listens;
    attends_ = has_policy_ || peer_listens_;
}

ChannelWriter::Sent ChannelWriter::write_numbers(std::span<const std::byte> elements,
                                                 std::uint32_t element_bytes, std::uint64_t stamp) {
    if (!mutex_.lock_unless_rehearsing()) return Sent::no;
    const rt::ShortLock lock(mutex_, std::adopt_lock);
    if (!bound_) [[unlikely]]
        return Sent::no;
    // Numbers of 8 bytes follow one word, their count, so they need not be assembled into a message first.
    const std::size_t count = elements.size() / sizeof(std::uint64_t);
    const bool fits = sizeof(std::uint64_t) + elements.size() <= bound_->ring.max_record();
    if (element_bytes != sizeof(std::uint64_t) || count == 0 || !fits || attends_ || rt::rehearsing())
        [[unlikely]]
        return write_numbers_by_scratch(elements, element_bytes, stamp);
    if (!bound_->ring.try_publish_words(count, elements.data(), count, stamp)) [[unlikely]]
        return write_numbers_by_scratch(elements, element_bytes, stamp);
    return Sent::yes;
}

ChannelWriter::Sent ChannelWriter::write_numbers_by_scratch(std::span<const std::byte> elements,
                                                            std::uint32_t element_bytes,
                                                            std::uint64_t stamp) {
    const std::size_t bytes = elements.size();
    const std::uint64_t count = bytes / element_bytes; // the bytes after the count are zeros
    const std::size_t head = bytes == 0 ? sizeof(std::uint32_t) : wire::head_of_numbers(element_bytes);
    const auto room = bound_->ring.scratch();
    if (head + bytes > room.size()) [[unlikely]]
        return Sent::too_long;
    // Does the same as write_numbers(), for a peer that must be woken and waits until this is done.
    if (peer_listens_ && !has_policy_ && element_bytes == sizeof count && count != 0 && !rt::rehearsing()) {
        choose_sample();
        if (bound_->ring.try_publish_words(count, elements.data(), count, stamp)) {
            ring_peer();
            return Sent::yes;
        }
    }
    std::memcpy(room.data(), &count, sizeof count);
    wire::copy_block(room.data() + head, elements.data(), bytes);
    return publish(head + bytes, stamp) ? Sent::yes : Sent::no;
}

void ChannelWriter::count_converted() {
    const std::lock_guard lock(mutex_);
    if (bound_) bound_->ring.count_converted();
}

void ChannelWriter::refuse(std::string_view why) {
    const std::lock_guard lock(mutex_);
    if (bound_) bound_->ring.refuse();
    if (refused_.should_log())
        log::error("port '{}': a message cannot cross the link and is dropped, {} so far: {}", port_,
                   refused_.count(), why);
}

bool ChannelWriter::is_bound() const {
    const std::lock_guard lock(mutex_);
    return bound_.has_value();
}

std::size_t ChannelWriter::longest_record() const {
    const std::lock_guard lock(mutex_);
    return bound_ ? bound_->ring.max_record() : 0;
}

bool ChannelWriter::corrupt() const {
    const std::lock_guard lock(mutex_);
    return bound_ && bound_->ring.corrupt();
}

void ChannelWriter::bind(std::shared_ptr<shm::Segment> segment, shm::RingWriter ring) {
    const std::lock_guard lock(mutex_);
    bound_.emplace(BoundRing<shm::RingWriter>{std::move(segment), std::move(ring)});
    bound_->ring.set_waits_for_room(policy_.wait.count() != 0);
    room_ = 0;
    gave_up_ = false;
    send_last_again();
}

std::uint64_t ChannelWriter::unbind() {
    const std::lock_guard lock(mutex_);
    const std::uint64_t unread = bound_ ? unread_in(bound_->ring.counters()) : 0;
    bound_.reset();
    peer_listens_ = peer_slept_ = false;
    attends_ = has_policy_;
    return unread;
}

// ---- ChannelReader

namespace {

constexpr std::chrono::milliseconds shortest_check{1};

} // namespace

ChannelReader::KeptMessage::KeptMessage(const shm::Record& of_ring)
    : memory(shm::payload_front + of_ring.bytes.size()), record(of_ring) {
    const auto to = std::span(memory).subspan(shm::payload_front);
    std::copy(of_ring.bytes.begin(), of_ring.bytes.end(), to.begin());
    record.bytes = to;
    record.front = memory.data();
}

const shm::Record* ChannelReader::rehearse_read_locked() {
    if (!bound_) return nullptr;
    if (const auto* last = bound_->ring.again()) rt::note_crossings(last->sequence);
    return bound_->ring.rehearse_read();
}

const shm::Record* ChannelReader::read_kept_locked() {
    if (bound_ && bound_->ring.corrupt()) wake_supervisor_();
    if (!kept_) return nullptr;
    handed_out_ = std::move(kept_);
    // Returns nothing if the next peer has already sent a message.
    return bound_ && bound_->ring.counters().received != 0 ? nullptr : &handed_out_->record;
}

bool ChannelReader::corrupt() const {
    const std::lock_guard lock(mutex_);
    return bound_ && bound_->ring.corrupt();
}

shm::RingCounters ChannelReader::counters() const {
    const std::lock_guard lock(mutex_);
    return bound_ ? bound_->ring.counters() : shm::RingCounters{};
}

bool ChannelReader::is_bound() const {
    const std::lock_guard lock(mutex_);
    return bound_.has_value();
}

void ChannelReader::set_depth_locked(std::uint64_t messages) {
    depth_ = messages;
    if (bound_) bound_->ring.set_depth(depth_);
}

void ChannelReader::set_room_locked(std::optional<std::uint64_t> messages) {
    room_ = messages;
    if (bound_) bound_->ring.set_room(room_);
}

std::uint64_t ChannelReader::discard() {
    const std::lock_guard lock(mutex_);
    const std::uint64_t waiting = bound_ ? bound_->ring.counters().waiting() : 0;
    if (waiting != 0) bound_->ring.read_newest(); // skips all older messages
    const std::uint64_t kept = kept_ ? 1 : 0;
    kept_.reset();
    return waiting + kept;
}

void ChannelReader::set_policy(const PortPolicy& policy) {
    {
        const std::lock_guard lock(mutex_);
        policy_ = policy;
        has_deadline_.store(policy.deadline.count() != 0, std::memory_order_relaxed);
    }
    if (policy.deadline.count() != 0) wake_supervisor_();
}

std::chrono::nanoseconds ChannelReader::deadline_check_in() const {
    if (!has_deadline_.load(std::memory_order_relaxed)) return shm::longest_wait;
    const std::lock_guard lock(mutex_);
    if (!bound_) return shm::longest_wait;
    return silent_ ? policy_.deadline
                   : std::max<std::chrono::nanoseconds>(policy_.deadline / 10, shortest_check);
}

bool ChannelReader::has_missed_deadline(std::chrono::steady_clock::time_point now) {
    if (!has_deadline_.load(std::memory_order_relaxed)) return false;
    const std::lock_guard lock(mutex_);
    if (!bound_) return false;
    const std::uint64_t sent = bound_->ring.counters().sent;
    if (sent != last_sent_ || last_change_ == std::chrono::steady_clock::time_point{}) {
        last_sent_ = sent;
        last_change_ = now;
        silent_ = false;
    }
    if (silent_ || now - last_change_ <= policy_.deadline) return false;
    silent_ = true;
    ++missed_deadlines_;
    bound_->ring.count_missed_deadline();
    return true;
}

std::uint64_t ChannelReader::missed_deadlines() const {
    const std::lock_guard lock(mutex_);
    return missed_deadlines_;
}

std::chrono::milliseconds ChannelReader::deadline() const {
    const std::lock_guard lock(mutex_);
    return policy_.deadline;
}

void ChannelReader::bind(std::shared_ptr<shm::Segment> segment, shm::RingReader ring) {
    const std::lock_guard lock(mutex_);
    bound_.emplace(BoundRing<shm::RingReader>{std::move(segment), std::move(ring)});
    bound_->ring.set_depth(depth_);
    bound_->ring.set_room(room_);
    last_sent_ = 0;
    last_change_ = {};
    silent_ = false;
}

std::uint64_t ChannelReader::unbind() {
    const std::lock_guard lock(mutex_);
    if (!bound_) return 0;
    if (const auto* last = bound_->ring.again()) handed_out_ = std::make_unique<KeptMessage>(*last);
    const shm::Record* record = std::exchange(announced_, false) ? bound_->ring.read() : nullptr;
    if (record) kept_ = std::make_unique<KeptMessage>(*record);
    const std::uint64_t unread = unread_in(bound_->ring.counters());
    bound_.reset();
    return unread;
}

} // namespace tandem::link
