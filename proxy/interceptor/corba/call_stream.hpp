// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/corba/stamped_stream.hpp"
#include "proxy/wire/cdr.hpp"

#include <cstddef>
#include <span>

namespace tandem::interceptor {

/// The stream of a call: marshals a message of any length into a buffer, which grows with it, and unmarshals another
/// message. Padding is zero, so that equal values have equal bytes.
class CallStream final : public StampedStream {
  public:
    CallStream() = default;
    /// Begins to write. The message follows the first `begin` bytes of the buffer (a multiple of 8), which stay unchanged.
    void write_to(wire::MessageBuffer& buffer, std::size_t begin = 0);
    /// Returns the buffer from its beginning to the end of the message.
    std::span<const std::byte> written() const;
    /// Begins to read. The message is aligned to 8 and not changed.
    void read_from(std::span<const std::byte> message);

    void get_octet_array(_CORBA_Octet* to, int size, omni::alignment_t alignment) override;
    void skipInput(_CORBA_ULong size) override;
    _CORBA_Boolean checkInputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) override;
    Position currentInputPtr() const override;
    void fetchInputData(omni::alignment_t alignment, std::size_t bytes) override;

    void put_octet_array(const _CORBA_Octet* from, int size, omni::alignment_t alignment) override;
    _CORBA_Boolean checkOutputOverrun(_CORBA_ULong, _CORBA_ULong, omni::alignment_t) override { return true; }
    Position currentOutputPtr() const override { return static_cast<Position>(used()); }
    _CORBA_Boolean reserveOutputSpaceForPrimitiveType(omni::alignment_t, std::size_t bytes) override;
    _CORBA_Boolean maybeReserveOutputSpace(omni::alignment_t, std::size_t bytes) override;

  private:
    static constexpr std::size_t first_room = 64; ///< zeros for a short message, without a loop

    std::size_t used() const {
        return static_cast<std::size_t>(static_cast<std::byte*>(pd_outb_mkr) - body_.data());
    }
    void add_room(std::size_t bytes);

    wire::MessageBuffer* buffer_ = nullptr;
    std::size_t begin_ = 0;
    // body_ is the part that was filled with zeros and may be written.
};

} // namespace tandem::interceptor
