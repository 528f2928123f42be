// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace tandem::interceptor {

/// A CORBA stream over one message in shared memory, in the machine's byte order. A timed message begins with
/// the 8 bytes of RTM's time, which do not lie in front of the payload but in the record's header: the stream
/// consists of two parts, `time_` and `body_`. Accesses beyond the end throw CORBA::MARSHAL. The overrides are
/// those that omniORB 4.2 calls (omniORB4/cdrStream.h); the two subclasses implement one direction each.
class StampedStream : public cdrStream {
  protected:
    explicit StampedStream(std::span<std::byte> body);
    [[noreturn]] static void throw_marshal();

    void put_octet_array(const _CORBA_Octet*, int, omni::alignment_t) override { throw_marshal(); }
    void get_octet_array(_CORBA_Octet*, int, omni::alignment_t) override { throw_marshal(); }
    void skipInput(_CORBA_ULong) override { throw_marshal(); }
    _CORBA_Boolean checkInputOverrun(_CORBA_ULong, _CORBA_ULong, omni::alignment_t) override { return false; }
    _CORBA_Boolean checkOutputOverrun(_CORBA_ULong, _CORBA_ULong, omni::alignment_t) override {
        return false;
    }
    _CORBA_ULong currentInputPtr() const override { return 0; }
    _CORBA_ULong currentOutputPtr() const override { return 0; }
    void fetchInputData(omni::alignment_t, std::size_t) override { throw_marshal(); }
    _CORBA_Boolean reserveOutputSpaceForPrimitiveType(omni::alignment_t, std::size_t) override {
        throw_marshal();
    }
    _CORBA_Boolean maybeReserveOutputSpace(omni::alignment_t, std::size_t) override { throw_marshal(); }

    /// Returns where the next `bytes` bytes at that alignment begin, and moves `cursor` behind them. When the
    /// time is used up, `cursor` and `end` move to the body.
    std::byte* align_and_advance(void*& cursor, void*& end, std::size_t bytes, omni::alignment_t alignment);

    alignas(8) std::byte time_[8];
    std::span<std::byte> body_;
    bool in_time_ = false; ///< the current position is in time_, not yet in body_
};

/// Marshals a message into `body`, whose size is at least the message's length (without a time).
class StampedOutStream final : public StampedStream {
  public:
    StampedOutStream(std::span<std::byte> body, bool timed);
    /// True if exactly as many bytes were written as there is room for.
    bool is_complete() const;
    /// How much of the body was written.
    std::size_t body_bytes() const;
    /// The time of a timed message, as wire::pack_time() packs it.
    std::uint64_t packed_time() const;

    void put_octet_array(const _CORBA_Octet* from, int size, omni::alignment_t alignment) override;
    _CORBA_Boolean checkOutputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) override;
    _CORBA_ULong currentOutputPtr() const override;
    _CORBA_Boolean reserveOutputSpaceForPrimitiveType(omni::alignment_t alignment,
                                                      std::size_t bytes) override;
    _CORBA_Boolean maybeReserveOutputSpace(omni::alignment_t alignment, std::size_t bytes) override;
};

/// Unmarshals a message from `body`.
class StampedInStream final : public StampedStream {
  public:
    /// `body` is only read. If the message is timed, `stamp` is what it begins with.
    StampedInStream(std::span<const std::byte> body, bool timed, std::uint64_t stamp);

    void get_octet_array(_CORBA_Octet* to, int size, omni::alignment_t alignment) override;
    void skipInput(_CORBA_ULong size) override;
    _CORBA_Boolean checkInputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) override;
    _CORBA_ULong currentInputPtr() const override;
    void fetchInputData(omni::alignment_t alignment, std::size_t bytes) override;
};

} // namespace tandem::interceptor
