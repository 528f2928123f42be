// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <omniORB4/CORBA.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace tandem::interceptor {

/// CORBA streams over one message in shared memory, in the machine's byte order. If the message is timed, the
/// first 8 bytes of what is marshalled are RTM's time, which lies apart, in the record's header. What goes
/// over an end throws CORBA::MARSHAL. Both are for one direction only.
class StampedStream : public cdrStream {
  protected:
    explicit StampedStream(std::span<std::byte> body);
    [[noreturn]] static void over();

    void put_octet_array(const _CORBA_Octet*, int, omni::alignment_t) override { over(); }
    void get_octet_array(_CORBA_Octet*, int, omni::alignment_t) override { over(); }
    void skipInput(_CORBA_ULong) override { over(); }
    _CORBA_Boolean checkInputOverrun(_CORBA_ULong, _CORBA_ULong, omni::alignment_t) override { return false; }
    _CORBA_Boolean checkOutputOverrun(_CORBA_ULong, _CORBA_ULong, omni::alignment_t) override {
        return false;
    }
    _CORBA_ULong currentInputPtr() const override { return 0; }
    _CORBA_ULong currentOutputPtr() const override { return 0; }
    void fetchInputData(omni::alignment_t, std::size_t) override { over(); }
    _CORBA_Boolean reserveOutputSpaceForPrimitiveType(omni::alignment_t, std::size_t) override { over(); }
    _CORBA_Boolean maybeReserveOutputSpace(omni::alignment_t, std::size_t) override { over(); }

    /// Where `bytes` bytes at that alignment begin, from `mark` on, in the part that is in use or, when that
    /// is used up, in the next one. Moves the mark behind them.
    std::byte* take(void*& mark, void*& end, std::size_t bytes, omni::alignment_t alignment);

    alignas(8) std::byte time_[8];
    std::span<std::byte> body_;
    bool in_time_ = false;
};

class StampedOutStream final : public StampedStream {
  public:
    StampedOutStream(std::span<std::byte> body, bool timed);
    /// Whether exactly that many bytes were written.
    bool full() const;
    std::uint64_t stamp() const; ///< of a timed message

    void put_octet_array(const _CORBA_Octet* from, int size, omni::alignment_t alignment) override;
    _CORBA_Boolean checkOutputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) override;
    _CORBA_ULong currentOutputPtr() const override;
    _CORBA_Boolean reserveOutputSpaceForPrimitiveType(omni::alignment_t alignment,
                                                      std::size_t bytes) override;
    _CORBA_Boolean maybeReserveOutputSpace(omni::alignment_t alignment, std::size_t bytes) override;
};

class StampedInStream final : public StampedStream {
  public:
    /// `body` is only read. The stamp is a part of the message if it is timed.
    StampedInStream(std::span<const std::byte> body, bool timed, std::uint64_t stamp);

    void get_octet_array(_CORBA_Octet* to, int size, omni::alignment_t alignment) override;
    void skipInput(_CORBA_ULong size) override;
    _CORBA_Boolean checkInputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) override;
    _CORBA_ULong currentInputPtr() const override;
    void fetchInputData(omni::alignment_t alignment, std::size_t bytes) override;
};

} // namespace tandem::interceptor
