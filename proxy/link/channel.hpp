// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "shm/segment.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

namespace tandem::link {

/// What an end of a channel is bound to: a ring, and the segment that keeps it mapped.
template <class End>
struct Bound {
    std::shared_ptr<shm::Segment> segment;
    End end;
};

/// Sending end of a data port across the link. It outlives the partner: unbound, it counts what nobody could
/// get. The mutex is this process's own and is held by others only while the link is bound or unbound.
class ChannelWriter {
  public:
    /// Calls encode(CdrWriter&), twice if the message outgrew its room, and publishes what it wrote.
    /// False: no partner, or the ring refused the message. [any-thread]
    template <class Encode>
    bool write(std::uint64_t stamp, Encode&& encode) {
        const std::lock_guard lock(mutex_);
        if (!bound_) return ++unlinked_, false;
        for (int attempt = 0; attempt < 2; ++attempt) {
            const auto room = bound_->end.reserve(room_);
            if (room.data() == nullptr) return false;
            wire::CdrWriter writer(room);
            encode(writer);
            if (writer.fits()) return commit(writer.size(), stamp), !bound_->end.corrupt();
            bound_->end.abandon();
            room_ = writer.size();
        }
        return false;
    }

    bool bound() const;
    bool corrupt() const;
    /// Messages written while there was no partner.
    std::uint64_t unlinked() const;
    shm::RingCounters counters() const;

    void bind(std::shared_ptr<shm::Segment>, shm::RingWriter);
    void unbind();

  private:
    void commit(std::size_t bytes, std::uint64_t stamp);

    mutable std::mutex mutex_;
    std::optional<Bound<shm::RingWriter>> bound_;
    std::size_t room_ = 64; ///< as large as the largest message so far
    std::uint64_t unlinked_ = 0;
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
