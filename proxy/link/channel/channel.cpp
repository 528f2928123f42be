// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel/channel.hpp"

#include "shm/segment/segment_file.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace tandem::link {

// ---- ChannelWriter; the private functions are called with mutex_ held

bool ChannelWriter::publish(std::size_t bytes, std::uint64_t stamp) {
    if (!bound_->ring.commit(bytes, stamp)) return false;
    // After the commit, so that whoever the doorbell wakes finds the message.
    if (peer_listens_.load(std::memory_order_relaxed)) bound_->segment->ring_peer(message_bit);
    return true;
}

/// Logs why the ring refused a message of that length; the ring itself only counts it. Rings that drop the
/// oldest message refuse for two reasons: the message is longer than a chunk, or /dev/shm has no memory left
/// for the chunk. Always returns false.
bool ChannelWriter::report_refusal(std::size_t bytes) {
    const std::size_t limit = bound_->ring.max_message();
    if (bytes > limit) {
        // Once per limit: a component sends such messages in every cycle.
        if (limit != std::exchange(reported_limit_, limit))
            spdlog::error("port '{}': a message of {} bytes is longer than {} and is dropped, as all such "
                          "will be; raise large_kib to {} or more",
                          port_, bytes, limit, (bytes + 1023) / 1024);
    } else if (!bound_->ring.corrupt() && no_memory_.should_log()) {
        spdlog::error("port '{}': a message of {} bytes finds no memory in {} and is dropped, {} so far; {} "
                      "bytes are available: free some or enlarge it",
                      port_, bytes, shm::shm_directory, no_memory_.count(),
                      shm::available_bytes().value_or(0));
    }
    return false;
}

void ChannelWriter::refuse(std::string_view why) {
    const std::lock_guard lock(mutex_);
    if (bound_) bound_->ring.refuse();
    if (refused_.should_log())
        spdlog::error("port '{}': a message cannot cross the link and is dropped, {} so far: {}", port_,
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
}

void ChannelWriter::unbind() {
    const std::lock_guard lock(mutex_);
    bound_.reset();
    set_peer_listens(false);
}

// ---- ChannelReader

bool ChannelReader::corrupt() const {
    const std::lock_guard lock(mutex_);
    return bound_ && bound_->ring.corrupt();
}

bool ChannelReader::empty() const {
    const std::lock_guard lock(mutex_);
    return !bound_ || bound_->ring.empty();
}

shm::RingCounters ChannelReader::counters() const {
    const std::lock_guard lock(mutex_);
    return bound_ ? bound_->ring.counters() : shm::RingCounters{};
}

void ChannelReader::bind(std::shared_ptr<shm::Segment> segment, shm::RingReader ring) {
    const std::lock_guard lock(mutex_);
    bound_.emplace(BoundRing<shm::RingReader>{std::move(segment), std::move(ring)});
}

void ChannelReader::unbind() {
    const std::lock_guard lock(mutex_);
    bound_.reset();
}

} // namespace tandem::link
