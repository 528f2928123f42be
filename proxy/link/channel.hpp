// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/log_throttle.hpp"
#include "proxy/wire/cdr.hpp"
#include "shm/segment.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace tandem::link {

/// From here on, handing a message over without a copy is worth more than to do it as always.
constexpr std::size_t large_message_bytes = std::size_t{64} * 1024;

/// What an end of a channel is bound to: a ring, and the segment that keeps it mapped.
template <class End>
struct Bound {
    std::shared_ptr<shm::Segment> segment;
    End end;
};

/// Sending end of a data port across the link. It outlives the peer: unbound, it counts what nobody could
/// get. The mutex is this process's own and is held by others only while the link is bound or unbound.
class ChannelWriter {
  public:
    explicit ChannelWriter(std::string port) : port_(std::move(port)) {}

    /// Publishes what encode(CdrWriter&) writes: where the peer will read it, if it is too long for the
    /// ring itself. Then encode is called twice, the first time only to learn the length. `stamp` is read
    /// afterwards: encode may set it. False: no peer, or the ring refused the message. [any-thread]
    template <class Encode>
    bool write(const std::uint64_t& stamp, Encode&& encode) {
        const std::lock_guard lock(mutex_);
        if (!bound_) return ++dropped_without_peer_, false;
        std::size_t bytes = bound_->end.in_ring();
        for (int attempt = 0; attempt < 2; ++attempt) {
            const auto room = bound_->end.reserve(bytes);
            if (room.data() == nullptr) return refused(bytes);
            wire::CdrWriter writer(room);
            encode(writer);
            if (writer.fits()) return bound_->end.commit(writer.size(), stamp, 0);
            bound_->end.abandon();
            bytes = writer.size();
        }
        return false;
    }

    /// The same for a message of known length: fill(std::span<std::byte>) writes all of it, or returns false
    /// to send nothing after all.
    template <class Fill>
    bool write_sized(std::size_t bytes, const std::uint64_t& stamp, Fill&& fill) {
        const std::lock_guard lock(mutex_);
        if (!bound_) return ++dropped_without_peer_, false;
        const auto room = bound_->end.reserve(bytes);
        if (room.data() == nullptr) return refused(bytes);
        const bool filled = fill(room);
        if (!filled) bound_->end.abandon();
        return filled && bound_->end.commit(bytes, stamp, 0);
    }

    bool bound() const;
    bool corrupt() const;
    /// Messages written while there was no peer.
    std::uint64_t dropped_without_peer() const;
    shm::RingCounters counters() const;

    void bind(std::shared_ptr<shm::Segment>, shm::RingWriter);
    void unbind();

  private:
    bool refused(std::size_t bytes);

    mutable std::mutex mutex_;
    std::optional<Bound<shm::RingWriter>> bound_;
    const std::string port_;
    std::uint64_t dropped_without_peer_ = 0;
    std::size_t reported_limit_ = 0; ///< that a message was longer than has been said
    LogThrottle no_memory_;
};

/// Receiving end. What is read lies in the shared ring itself: no thread hands it over.
class ChannelReader {
  public:
    bool empty() const;
    bool corrupt() const;
    /// The oldest message that was not read, newest if asked for; passed to use(Record) while the channel is
    /// held.
    template <class Use>
    bool read(bool newest, Use&& use) {
        const std::lock_guard lock(mutex_);
        if (!bound_) return false;
        const auto record = newest ? bound_->end.read_newest() : bound_->end.read();
        if (!record) return false;
        use(*record);
        return true;
    }

    /// For readers that take the message apart step by step: lock, then next() and finally unlock.
    std::unique_lock<std::mutex> hold() { return std::unique_lock(mutex_); }
    std::optional<shm::Record> next() { return bound_ ? bound_->end.read() : std::nullopt; }

    shm::RingCounters counters() const;

    void bind(std::shared_ptr<shm::Segment>, shm::RingReader);
    void unbind();

  private:
    mutable std::mutex mutex_;
    std::optional<Bound<shm::RingReader>> bound_;
};

} // namespace tandem::link
