// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "host/rt/short_mutex.hpp"
#include "proxy/link/channel/port_policy.hpp"
#include "proxy/wire/cdr.hpp"
#include "shm/ring/message_snapshot.hpp"
#include "shm/segment.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

/// The doorbell bit for "a message was written". All ports share it: ArrivalNotifier finds the port by comparing
/// counters, so the two sides need not agree on port numbers.
constexpr unsigned message_bit = 0;

/// A ring, and the segment that keeps it mapped.
template <class Ring>
struct BoundRing {
    std::shared_ptr<shm::Segment> segment;
    Ring ring;
};

/// The sending end of a data port across the link. It outlives the peer: while it is not bound to a ring, messages
/// are dropped. Its mutex belongs to this process. Other threads lock it only to bind and unbind.
class ChannelWriter {
  public:
    /// `wake_supervisor` is called when the ring turns out to be damaged. It must outlive this object.
    ChannelWriter(std::string port, const std::function<void()>& wake_supervisor)
        : port_(std::move(port)), wake_supervisor_(wake_supervisor) {}

    /// Publishes the output of `encode(CdrWriter&)`. A message that is too long for the ring goes into a chunk;
    /// `encode` is then called twice, first only to determine the length. Reads `stamp` after `encode`, which may set
    /// it. Returns false without a peer or if the ring refuses the message. Sends nothing in a rehearsal. [any-thread]
    template <class Encode>
    bool write(const std::uint64_t& stamp, Encode&& encode) {
        if (!mutex_.lock_unless_rehearsing()) return false;
        const rt::ShortLock lock(mutex_, std::adopt_lock);
        if (!bound_) [[unlikely]]
            return false;
        wire::CdrWriter writer(bound_->ring.scratch());
        encode(writer);
        if (writer.fits()) [[likely]]
            return publish(writer.size(), stamp);
        return !rt::rehearsing() && encode_in_chunk(writer.size(), stamp, encode);
    }

    /// Like write(), but encodes a message that is too long for the ring only once if it is as long as the last one,
    /// `bytes`. Sets `bytes` to the message's length. For an `encode` that takes long.
    template <class Encode>
    bool write_expecting(std::size_t& bytes, const std::uint64_t& stamp, Encode&& encode) {
        if (bytes > longest_record()) {
            bool as_expected = true; // while nothing was encoded
            const bool sent = write_sized(bytes, stamp, [&](std::span<std::byte> room) {
                wire::CdrWriter writer(room);
                encode(writer);
                return as_expected = writer.size() == room.size();
            });
            if (as_expected) return sent;
        }
        return write(stamp, [&](wire::CdrWriter& writer) {
            encode(writer);
            bytes = writer.size();
        });
    }

    /// Publishes a message of known length. `fill(std::span<std::byte>)` returns false to cancel sending.
    template <class Fill>
    bool write_sized(std::size_t bytes, const std::uint64_t& stamp, Fill&& fill) {
        const std::lock_guard lock(mutex_);
        if (!bound_) return false;
        const auto fill_all = [&](std::span<std::byte> room) {
            return fill(room) ? std::optional(bytes) : std::nullopt;
        };
        return bytes <= bound_->ring.max_record() ? write_in_record(bytes, stamp, fill_all)
                                                  : write_in_chunk(bytes, stamp, fill_all);
    }

    /// Publishes a message whose length is known after encoding. `fill(room)` returns the length, or nothing if the
    /// message does not fit into a record of the ring. It may overwrite the shm::payload_front bytes before `room`.
    template <class Fill>
    bool write_record(const std::uint64_t& stamp, Fill&& fill) {
        if (!mutex_.lock_unless_rehearsing()) return false;
        const rt::ShortLock lock(mutex_, std::adopt_lock);
        return bound_ && write_in_record(bound_->ring.max_record(), stamp, fill);
    }

    /// Publishes a sequence of numbers of 1, 2, 4 or 8 bytes each, in the format of put_sequence(). Returns too_long,
    /// without side effects, if the message does not fit into a record.
    enum class Sent : std::uint8_t { no, yes, too_long };
    Sent write_numbers(std::span<const std::byte> elements, std::uint32_t element_bytes, std::uint64_t stamp);

    /// Counts a message that was written after a conversion.
    void count_converted();
    /// Counts a message that cannot cross as sent and dropped. Logs `why`, one line, at a limited rate.
    void refuse(std::string_view why);

    bool is_bound() const;
    /// Returns true if a write that has returned `written` did not fail: without a peer, the port is not connected.
    bool is_success(bool written) const { return written || rt::rehearsing() || !is_bound(); }
    /// Returns the maximum size of a record of the ring in bytes, or 0 without a ring.
    std::size_t longest_record() const;
    /// Returns true if another process has damaged the ring. Nothing more is sent through it.
    bool corrupt() const;

    /// Sets the policy. Call it before the port is in use. The message kept by keep_last survives the peer.
    void set_policy(const PortPolicy& policy);

    /// Sets whether the peer waits for messages of this port. If so, each message rings the peer's doorbell, which
    /// costs a system call if the peer sleeps. Ends with unbind(), because the next peer must ask again.
    void set_peer_listens(bool listens);

    void bind(std::shared_ptr<shm::Segment>, shm::RingWriter);
    /// Returns the number of messages in the ring that the peer has not read, or 0 if the peer has never read any.
    std::uint64_t unbind();

  private:
    // Require mutex_ and a bound ring. `fill(room)` returns how many of `bytes` bytes it has used, or nothing to
    // cancel.
    template <class Fill>
    bool write_in_record(std::size_t bytes, const std::uint64_t& stamp, Fill&& fill) {
        const std::optional<std::size_t> used = fill(bound_->ring.scratch().first(bytes));
        return used && publish(*used, stamp);
    }
    /// Publishes the first `bytes` of the ring's scratch memory. Returns false if the message was refused.
    bool publish(std::size_t bytes, std::uint64_t stamp) {
        if (attends_ || rt::rehearsing()) [[unlikely]]
            return publish_attending(bytes, stamp);
        return bound_->ring.publish(bytes, stamp) || report_refusal(bytes);
    }
    bool publish_attending(std::size_t bytes, std::uint64_t stamp);
    Sent write_numbers_by_scratch(std::span<const std::byte> elements, std::uint32_t element_bytes,
                                  std::uint64_t stamp);
    template <class Encode>
    bool encode_in_chunk(std::size_t bytes, const std::uint64_t& stamp, Encode&& encode) {
        return write_in_chunk(bytes, stamp, [&](std::span<std::byte> room) -> std::optional<std::size_t> {
            wire::CdrWriter writer(room);
            encode(writer);
            // The value may have changed meanwhile and be longer than before.
            return writer.fits() ? std::optional(writer.size()) : std::nullopt;
        });
    }
    template <class Fill>
    bool write_in_chunk(std::size_t bytes, const std::uint64_t& stamp, Fill&& fill) {
        shm::RingWriter& ring = bound_->ring;
        const auto room = ring.reserve(bytes);
        if (room.data() == nullptr) return report_refusal(bytes);
        Reservation reservation{&ring}; // fill() may also throw
        const std::optional<std::size_t> used = fill(room);
        if (!used) return false;
        reservation.ring = nullptr;
        return publish_chunk(room.first(*used), stamp);
    }
    struct Reservation {
        shm::RingWriter* ring;
        ~Reservation() {
            if (ring) ring->cancel_reservation();
        }
    };
    bool publish_chunk(std::span<const std::byte> message, std::uint64_t stamp);
    bool follow_policy(std::span<const std::byte> message, std::uint64_t stamp);
    bool make_room(std::size_t bytes);
    bool wait_for_room(std::size_t bytes);
    bool is_below_depth();
    bool is_full_for_all();
    bool drop_for_room(const std::string& why);
    void send_last_again();
    bool report_refusal(std::size_t bytes);
    bool report_damage();
    void ring_peer();
    void choose_sample();

    mutable rt::ShortMutex mutex_;
    std::optional<BoundRing<shm::RingWriter>> bound_;
    const std::string port_;
    const std::function<void()>& wake_supervisor_;
    bool peer_listens_ = false;
    bool peer_slept_ = false;        ///< at the last message
    std::size_t reported_limit_ = 0; ///< the ring's limit when the last too long message was logged
    process::LogThrottle no_memory_, refused_, no_room_;
    PortPolicy policy_;
    std::uint64_t room_ = 0;      ///< number of messages known to fit into the reader's depth
    bool gave_up_ = false;        ///< the last wait timed out, and the slowest target has read nothing since
    bool has_policy_ = false;     ///< policy_ requires an action of the writer
    bool attends_ = false;        ///< has_policy_, or the peer listens
    std::vector<std::byte> last_; ///< with keep_last: the last message
    std::uint64_t last_stamp_ = 0;
    bool has_last_ = false;
};

/// The receiving end of a data port across the link. The component's thread reads messages directly from the shared
/// ring, without an intermediate thread. Unbound, the channel is empty, with one exception: a component that was just
/// told of a message gets it even if the peer dies in between.
class ChannelReader {
  public:
    /// `wake_supervisor` is called when the ring turns out to be damaged or a deadline is set. It must outlive this
    /// object.
    explicit ChannelReader(const std::function<void()>& wake_supervisor)
        : wake_supervisor_(wake_supervisor) {}
    bool empty() const {
        const rt::ShortLock lock(mutex_);
        if (!bound_) [[unlikely]]
            return !kept_;
        const bool empty = bound_->ring.empty();
        announced_ = !empty;
        return empty;
    }
    /// Returns true if another process has damaged the ring. Nothing more is received through it.
    bool corrupt() const;

    /// Passes the oldest unread message, or with `newest` the newest one, to `use(const Record&)`. The record is
    /// valid only during this call, because the next read reuses its memory. A `use` that reads bytes more than once
    /// takes them from a shm::MessageSnapshot. Returns false if there is none.
    /// [any-thread]
    template <class Use>
    bool read(bool newest, Use&& use) {
        const rt::ShortLock lock(mutex_);
        const shm::Record* record = nullptr;
        if (bound_) [[likely]]
            record = newest ? bound_->ring.read_newest() : bound_->ring.read();
        if (!record) record = read_kept_locked();
        if (!record) return false;
        use(*record);
        return true;
    }
    /// Returns the mutex, for readers that read several messages or may rehearse: lock it, then call read_locked() and
    /// decode. The record is valid while the lock is held. In a rehearsal read_locked() returns the last message again.
    rt::ShortMutex& mutex() { return mutex_; }
    const shm::Record* read_locked() {
        if (rt::rehearsing()) [[unlikely]]
            return rehearse_read_locked();
        if (bound_) [[likely]]
            if (const auto* record = bound_->ring.read()) [[likely]]
                return record;
        return read_kept_locked();
    }

    /// Returns the last message again, even a long one, for a port that repeats its last message while its queue is
    /// empty. The message outlives the peer. Requires the lock.
    const shm::Record* again_locked() const {
        const shm::Record* const last = bound_ ? bound_->ring.again() : nullptr;
        return last || !handed_out_ ? last : &handed_out_->record;
    }

    /// Count a message that was read: a converted message, one that is not a value of the port's type, or one for which a
    /// receiving port had no room. Require the lock.
    void count_converted_locked() {
        if (bound_) bound_->ring.count_converted();
    }
    void count_undecodable_locked() {
        if (bound_) bound_->ring.count_undecodable();
    }
    void count_discarded_locked() {
        if (bound_) bound_->ring.count_discarded();
    }
    void count_undecodable() {
        const std::lock_guard lock(mutex_);
        count_undecodable_locked();
    }
    void count_discarded() {
        const std::lock_guard lock(mutex_);
        count_discarded_locked();
    }

    shm::RingCounters counters() const; ///< Returns the counters of the bound ring, or zeros without a ring.
    /// Returns the number of messages that the peer has sent.
    std::uint64_t sent() const {
        const rt::ShortLock lock(mutex_);
        return bound_ ? bound_->ring.sent() : 0;
    }
    /// Returns the number of waiting messages. Requires the lock.
    std::uint64_t waiting_locked() const {
        if (!bound_) [[unlikely]]
            return kept_ ? 1 : 0;
        const std::uint64_t waiting = bound_->ring.waiting();
        announced_ = waiting != 0;
        return waiting;
    }
    bool is_bound() const;
    /// Sets the queue length of the receiving port. The reader skips all waiting messages except the newest
    /// `messages`; 0: skips none. [any-thread]
    void set_depth(std::uint64_t messages) {
        const std::lock_guard lock(mutex_);
        set_depth_locked(messages);
    }
    void set_depth_locked(std::uint64_t messages);
    /// Sets the room for several targets of one channel, see shm::RingReader::set_room(). Requires the lock.
    void set_room_locked(std::optional<std::uint64_t> messages);
    bool sender_waits_locked() const { return bound_ && bound_->ring.writer_waits_for_room(); }
    /// Removes all waiting messages from the ring unread. Returns their number. [any-thread]
    std::uint64_t discard();

    /// Sets the policy. Call it before the port is in use.
    void set_policy(const PortPolicy& policy);
    /// Returns how soon has_missed_deadline() must be called again to detect a silence at most a tenth of the
    /// deadline late, and the end of a silence within one deadline. Returns longest_wait without a deadline or a
    /// peer.
    std::chrono::nanoseconds deadline_check_in() const;
    /// Returns true, once per silence, if the sender has been silent for longer than the port's deadline since the
    /// last message or since the link came up. [supervisor-thread]
    bool has_missed_deadline(std::chrono::steady_clock::time_point now);
    std::uint64_t missed_deadlines() const; ///< Returns the number of silences so far.
    std::chrono::milliseconds deadline() const;
    bool has_deadline() const { return has_deadline_.load(std::memory_order_relaxed); }

    void bind(std::shared_ptr<shm::Segment>, shm::RingReader);
    /// Keeps the oldest message if it was announced. Returns the number of further messages in the ring, which are
    /// lost, or 0 if none was ever read.
    std::uint64_t unbind();

  private:
    /// A message from the ring of a peer that is gone.
    struct KeptMessage {
        explicit KeptMessage(const shm::Record& of_ring);
        std::vector<std::byte> memory;
        shm::Record record;
    };
    /// Call it when the ring is empty. Returns the kept message once, then nullptr. Requires mutex_.
    const shm::Record* read_kept_locked();
    const shm::Record* rehearse_read_locked();

    mutable rt::ShortMutex mutex_;
    std::optional<BoundRing<shm::RingReader>> bound_;
    mutable bool announced_ = false; ///< the last check for messages found some
    std::unique_ptr<KeptMessage> kept_, handed_out_;
    const std::function<void()>& wake_supervisor_;
    PortPolicy policy_;
    std::uint64_t depth_ = 0;
    std::optional<std::uint64_t> room_;
    /// True if policy_ has a deadline. Read without the lock: the supervisor reads it for all channels in each pass.
    /// By locking, it would become the owner of the mutex of ports that the component does not read yet.
    std::atomic<bool> has_deadline_{false};
    std::uint64_t last_sent_ = 0, missed_deadlines_ = 0; ///< last_sent_: the sender's count at last_change_
    std::chrono::steady_clock::time_point last_change_{};
    bool silent_ = false; ///< the deadline was missed since last_change_
};

} // namespace tandem::link
