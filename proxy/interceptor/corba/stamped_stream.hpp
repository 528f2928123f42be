// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

namespace tandem::interceptor {

/// A CORBA stream over a series of messages, in the machine's byte order. A timed message begins with the 8 bytes of RTM's
/// time, which travel in the record's header. If the memory before the payload is free, the time is put there, and the
/// stream's inline functions handle everything. Otherwise the stream consists of two parts, `time_` and `body_`. Accesses
/// beyond the end throw CORBA::MARSHAL. The overrides are those that omniORB 4.2 and 4.3 call (omniORB4/cdrStream.h); the two
/// subclasses implement one direction each.
class StampedStream : public cdrStream {
  public:
    static constexpr std::size_t time_bytes = 8;
    /// CORBA::ULong in omniORB 4.2, size_t in 4.3.
    using Position = decltype(std::declval<const cdrStream&>().currentInputPtr());

  protected:
    StampedStream();
    [[noreturn]] static void throw_marshal();
    /// Begins a message. Returns its start and end, or those of its first part.
    std::pair<void*, void*> open(std::span<std::byte> body, bool timed, std::byte* front);

    void put_octet_array(const _CORBA_Octet*, int, omni::alignment_t) override { throw_marshal(); }
    void get_octet_array(_CORBA_Octet*, int, omni::alignment_t) override { throw_marshal(); }
    void skipInput(_CORBA_ULong) override { throw_marshal(); }
    _CORBA_Boolean checkInputOverrun(_CORBA_ULong, _CORBA_ULong, omni::alignment_t) override { return false; }
    _CORBA_Boolean checkOutputOverrun(_CORBA_ULong, _CORBA_ULong, omni::alignment_t) override {
        return false;
    }
    Position currentInputPtr() const override { return 0; }
    Position currentOutputPtr() const override { return 0; }
    void fetchInputData(omni::alignment_t, std::size_t) override { throw_marshal(); }
    _CORBA_Boolean reserveOutputSpaceForPrimitiveType(omni::alignment_t, std::size_t) override {
        throw_marshal();
    }
    _CORBA_Boolean maybeReserveOutputSpace(omni::alignment_t, std::size_t) override { throw_marshal(); }

    /// Returns the place of the next `bytes` bytes at this alignment, and moves `cursor` past them. When the time is used
    /// up, `cursor` and `end` move to the body.
    std::byte* align_and_advance(void*& cursor, void*& end, std::size_t bytes, omni::alignment_t alignment) {
        if (in_time_ && cursor == end) [[unlikely]]
            leave_time(cursor, end);
        const auto place = reinterpret_cast<omni::ptr_arith_t>(cursor);
        const auto padding = static_cast<std::size_t>(omni::align_to(place, alignment) - place);
        const auto left =
            static_cast<std::size_t>(static_cast<std::byte*>(end) - static_cast<std::byte*>(cursor));
        // Subtracts instead of adding: the sum could overflow with a hostile length.
        if (padding > left || bytes > left - padding) [[unlikely]]
            throw_marshal();
        std::byte* const begin = static_cast<std::byte*>(cursor) + padding;
        cursor = begin + bytes;
        return begin;
    }

    alignas(8) std::byte own_time_[time_bytes];
    std::byte* time_ = own_time_; ///< the place of this message's time
    std::span<std::byte> body_;
    bool in_time_ = false; ///< the current position is in own_time_, not yet in body_

  private:
    void leave_time(void*& cursor, void*& end);
};

/// Marshals messages.
class StampedOutStream final : public StampedStream {
  public:
    StampedOutStream() = default;
    StampedOutStream(std::span<std::byte> body, bool timed) { open(body, timed); }
    /// Begins a message. `body` is at least as long as the message without its time. `front`: time_bytes bytes before
    /// `body` that may be overwritten; nullptr if there are none.
    void open(std::span<std::byte> body, bool timed, std::byte* front = nullptr) {
        std::tie(pd_outb_mkr, pd_outb_end) = StampedStream::open(body, timed, front);
    }
    /// Returns true if exactly as many bytes were written as there is room for.
    bool is_complete() const;
    /// Returns how many bytes of the body were written.
    std::size_t body_bytes() const;
    /// Returns the time of a timed message, as packed by wire::pack_time().
    std::uint64_t packed_time() const;

    void put_octet_array(const _CORBA_Octet* from, int size, omni::alignment_t alignment) override;
    _CORBA_Boolean checkOutputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) override;
    Position currentOutputPtr() const override;
    _CORBA_Boolean reserveOutputSpaceForPrimitiveType(omni::alignment_t alignment,
                                                      std::size_t bytes) override;
    _CORBA_Boolean maybeReserveOutputSpace(omni::alignment_t alignment, std::size_t bytes) override;
};

/// Unmarshals messages.
class StampedInStream final : public StampedStream {
  public:
    StampedInStream() = default;
    StampedInStream(std::span<const std::byte> body, bool timed, std::uint64_t stamp) {
        open(body, timed, stamp);
    }
    /// Begins a message. `body` is only read; `front` is that of StampedOutStream. A timed message begins with `stamp`.
    void open(std::span<const std::byte> body, bool timed, std::uint64_t stamp, std::byte* front = nullptr);

    void get_octet_array(_CORBA_Octet* to, int size, omni::alignment_t alignment) override;
    void skipInput(_CORBA_ULong size) override;
    _CORBA_Boolean checkInputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) override;
    Position currentInputPtr() const override;
    void fetchInputData(omni::alignment_t alignment, std::size_t bytes) override;
};

} // namespace tandem::interceptor
