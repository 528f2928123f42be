// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/channel.hpp"

namespace tandem::link {

void ChannelWriter::commit(std::size_t bytes, std::uint64_t stamp) {
    if (bytes > room_) room_ = bytes;
    bound_->end.commit(bytes, stamp, 0);
}

bool ChannelWriter::bound() const {
    const std::lock_guard lock(mutex_);
    return bound_.has_value();
}

bool ChannelWriter::corrupt() const {
    const std::lock_guard lock(mutex_);
    return bound_ && bound_->end.corrupt();
}

std::uint64_t ChannelWriter::unlinked() const {
    const std::lock_guard lock(mutex_);
    return unlinked_;
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
