// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rt/short_mutex.hpp"
#include "host/rt/value_ring.hpp"
#include <condition_variable>
#include <memory>
#include <mutex>
#include <rtm/CdrBufferBase.h>
#include <rtm/InPlaceBuffer.h>

namespace RTC {

/// The default buffer of an InPort, with the properties and policies of RingBuffer. Messages are encoded and decoded in
/// its memory. One thread writes and one reads without waiting for each other; further threads wait for their turn.
/// [any-thread]
class PortBuffer final : public CdrBufferBase, public InPlaceBuffer {
  public:
    PortBuffer();

    void init(const coil::Properties& prop) override;
    std::size_t length() const override;
    /// Drops the messages in the buffer.
    BufferStatus length(std::size_t n) override;
    BufferStatus reset() override;

    /// `timeout` > 0: waits this long for room, independent of the policy; 0: does not wait; < 0: uses the policy.
    BufferStatus write(const ByteData& message,
                       std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) override;
    BufferStatus writeReporting(const ByteData& message, bool& overwritten) override;
    std::size_t minInPlaceLength() const override { return 0; }
    /// A rehearsal encodes the message and does not publish it here; see rt::rehearsal_ring().
    BufferStatus writeInPlace(const Marshal& marshal) override;
    std::size_t writable() const override;
    bool full() const override { return writable() == 0; }

    /// `timeout` as in write().
    BufferStatus read(ByteData& message,
                      std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1)) override;
    /// A rehearsal decodes the last message once more.
    BufferStatus readInPlace(ByteData& message, Unmarshal& reader, bool& read_in_place) override;
    std::size_t readable() const override;
    /// Notes the lines that empty() uses (host/rt/cycle_lines.hpp). Does nothing unless the calling thread owns the end.
    void note_lines() const;
    bool empty() const override;

    // Access to messages without moving, and moves without access. They exclude both threads.
    ByteData* wptr(long n) override;
    BufferStatus advanceWptr(long n, bool unlock_enable) override;
    BufferStatus put(const ByteData& message) override;
    ByteData* rptr(long n) override;
    BufferStatus advanceRptr(long n, bool unlock_enable) override;
    BufferStatus get(ByteData& message) override;
    ByteData& get() override;

  private:
    using Ring = tandem::rt::ValueRing<ByteData>;

    /// How one call treats a full or an empty buffer.
    struct Turn {
        std::chrono::nanoseconds timeout; ///< the caller's, or the policy's for a call that waits
        bool waits = false;               ///< this call waits for the other end
        bool wakes = false;               ///< threads wait at the other end
    };
    template <class Publish>
    BufferStatus try_store(Turn& turn, const Publish& publish, bool& overwritten);
    template <class Publish>
    BufferStatus store(std::chrono::nanoseconds timeout, const Publish& publish, bool& overwritten);
    BufferStatus store_copy(const ByteData& message, std::chrono::nanoseconds timeout, bool& overwritten);
    template <class Decode>
    BufferStatus try_take(Turn& turn, const Decode& decode);
    template <class Decode>
    BufferStatus take(std::chrono::nanoseconds timeout, const Decode& decode);
    template <class Ready>
    bool wait(std::chrono::nanoseconds timeout, const Ready& ready);
    void wake();
    bool publish_encoded(const Marshal& marshal, bool& dropped);
    bool prepare_rehearsal_of_write();
    bool prepare_rehearsal_of_read(Unmarshal& reader);
    void settle();
    void set_length(std::size_t n);

    static constexpr std::size_t cache_line = 64; // of which the two threads write different ones

    // These change with both mutexes held, write_mutex_ first.
    alignas(cache_line) std::unique_ptr<Ring> ring_;
    bool overwrite_ = true;
    bool block_write_ = false;
    bool readback_ = true;
    bool block_read_ = false;
    std::chrono::nanoseconds write_timeout_ = std::chrono::seconds(1);
    std::chrono::nanoseconds read_timeout_ = std::chrono::seconds(1);

    alignas(cache_line) mutable tandem::rt::ShortMutex write_mutex_; // the writing end of ring_, and stream_
    cdrMemoryStream stream_;

    alignas(cache_line) mutable tandem::rt::ShortMutex read_mutex_; // the reading end of ring_
    bool has_last_ = false; // since the last reset: the reader's value is the last message

    std::mutex wait_mutex_; // held while a thread checks whether it must wait, before the other two
    std::condition_variable changed_;
};

} // namespace RTC
