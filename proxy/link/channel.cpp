// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel.hpp"

#include "shm/segment/segment_file.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace tandem::link {

/// Says why, for the ring has only counted it. A ring that drops the oldest has room for all but what is too
/// long for it, and chunks for which /dev/shm has no memory.
bool ChannelWriter::refused(std::size_t bytes) {
    const std::size_t limit = bound_->end.longest();
    if (bytes > limit) {
        if (limit != std::exchange(reported_limit_, limit))
            spdlog::error(
                "port '{}': a message of {} bytes is longer than {} and is dropped, as all such will be; "
                "raise large_kib to {} or more",
                port_, bytes, limit, (bytes + 1023) / 1024);
    } else if (!bound_->end.corrupt() && no_memory_.should_log()) {
        spdlog::error(
            "port '{}': a message of {} bytes finds no memory in {} and is dropped, {} so far; {} bytes "
            "are available: free some or enlarge it",
            port_, bytes, shm::shm_directory, no_memory_.count(), shm::available_bytes().value_or(0));
    }
    return false;
}

bool ChannelWriter::bound() const {
    const std::lock_guard lock(mutex_);
    return bound_.has_value();
}

bool ChannelWriter::corrupt() const {
    const std::lock_guard lock(mutex_);
    return bound_ && bound_->end.corrupt();
}

std::uint64_t ChannelWriter::dropped_without_peer() const {
    const std::lock_guard lock(mutex_);
    return dropped_without_peer_;
}

shm::RingCounters ChannelWriter::counters() const {
    const std::lock_guard lock(mutex_);
    return bound_ ? bound_->end.counters() : shm::RingCounters{};
}

void ChannelWriter::bind(std::shared_ptr<shm::Segment> segment, shm::RingWriter end) {
    const std::lock_guard lock(mutex_);
    bound_.emplace(Bound<shm::RingWriter>{std::move(segment), std::move(end)});
}

void ChannelWriter::unbind() {
    const std::lock_guard lock(mutex_);
    bound_.reset();
}

bool ChannelReader::corrupt() const {
    const std::lock_guard lock(mutex_);
    return bound_ && bound_->end.corrupt();
}

bool ChannelReader::empty() const {
    const std::lock_guard lock(mutex_);
    return !bound_ || bound_->end.empty();
}

shm::RingCounters ChannelReader::counters() const {
    const std::lock_guard lock(mutex_);
    return bound_ ? bound_->end.counters() : shm::RingCounters{};
}

void ChannelReader::bind(std::shared_ptr<shm::Segment> segment, shm::RingReader end) {
    const std::lock_guard lock(mutex_);
    bound_.emplace(Bound<shm::RingReader>{std::move(segment), std::move(end)});
}

void ChannelReader::unbind() {
    const std::lock_guard lock(mutex_);
    bound_.reset();
}

} // namespace tandem::link
