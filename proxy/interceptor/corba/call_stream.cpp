// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/call_stream.hpp"

#include <algorithm>
#include <cstring>

namespace tandem::interceptor {

void CallStream::write_to(wire::MessageBuffer& buffer, std::size_t begin) {
    buffer_ = &buffer;
    begin_ = begin;
    body_ = buffer.room_for(begin + first_room).subspan(begin);
    std::memset(body_.data(), 0, first_room);
    pd_outb_mkr = body_.data();
    pd_outb_end = body_.data() + first_room;
}

std::span<const std::byte> CallStream::written() const { return {body_.data() - begin_, begin_ + used()}; }

void CallStream::add_room(std::size_t bytes) {
    // Padding included. Doubled, so that a long message is not moved again and again.
    constexpr std::size_t max_padding = 8;
    const std::size_t before = body_.size(), at = used();
    const std::size_t room = std::max(2 * before, at + max_padding + bytes);
    body_ = buffer_->room_for(begin_ + room).subspan(begin_);
    std::memset(body_.data() + before, 0, room - before);
    pd_outb_mkr = body_.data() + at;
    pd_outb_end = body_.data() + room;
}

void CallStream::put_octet_array(const _CORBA_Octet* from, int size, omni::alignment_t alignment) {
    const auto bytes = static_cast<std::size_t>(size);
    maybeReserveOutputSpace(alignment, bytes);
    wire::copy_block(align_and_advance(pd_outb_mkr, pd_outb_end, bytes, alignment), from, bytes);
}

_CORBA_Boolean CallStream::reserveOutputSpaceForPrimitiveType(omni::alignment_t alignment,
                                                              std::size_t bytes) {
    return maybeReserveOutputSpace(alignment, bytes);
}

_CORBA_Boolean CallStream::maybeReserveOutputSpace(omni::alignment_t alignment, std::size_t bytes) {
    const auto mask = static_cast<std::size_t>(alignment) - 1;
    const std::size_t padded = (used() + mask) & ~mask;
    if (padded + bytes > body_.size()) add_room(bytes);
    return true;
}

void CallStream::read_from(std::span<const std::byte> message) {
    pd_inb_mkr = const_cast<std::byte*>(message.data());
    pd_inb_end = static_cast<std::byte*>(pd_inb_mkr) + message.size();
}

void CallStream::get_octet_array(_CORBA_Octet* to, int size, omni::alignment_t alignment) {
    const auto bytes = static_cast<std::size_t>(size);
    wire::copy_block(to, align_and_advance(pd_inb_mkr, pd_inb_end, bytes, alignment), bytes);
}

void CallStream::skipInput(_CORBA_ULong size) {
    align_and_advance(pd_inb_mkr, pd_inb_end, size, omni::ALIGN_1);
}

_CORBA_Boolean CallStream::checkInputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) {
    const auto left = static_cast<std::byte*>(pd_inb_end) - static_cast<std::byte*>(pd_inb_mkr);
    return std::size_t{size} * count <= static_cast<std::size_t>(left);
}

// Only distances mean something.
CallStream::Position CallStream::currentInputPtr() const {
    return static_cast<Position>(reinterpret_cast<omni::ptr_arith_t>(pd_inb_mkr));
}

// Called when less than a value is left.
void CallStream::fetchInputData(omni::alignment_t, std::size_t) { throw_marshal(); }

} // namespace tandem::interceptor
