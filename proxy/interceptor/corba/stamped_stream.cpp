// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/stamped_stream.hpp"

#include "proxy/wire/time.hpp"

#include <cstring>

namespace tandem::interceptor {
namespace {

std::byte* byte_at(const void* mark) { return const_cast<std::byte*>(static_cast<const std::byte*>(mark)); }

std::size_t distance(const void* from, const void* to) {
    return static_cast<std::size_t>(byte_at(to) - byte_at(from));
}

// How strings are transmitted: as a memory stream learns it from the ORB. It stays the same as long as the process lives.
const cdrStream& stream_with_code_sets() {
    static const cdrMemoryStream stream;
    return stream;
}

} // namespace

StampedStream::StampedStream(std::span<std::byte> body) : body_(body) {
    TCS_C(stream_with_code_sets().TCS_C());
    TCS_W(stream_with_code_sets().TCS_W());
    // The peer runs on this machine: no bytes are swapped. The subclasses set the pointers of their direction.
    pd_marshal_byte_swap = pd_unmarshal_byte_swap = false;
    pd_inb_mkr = pd_inb_end = pd_outb_mkr = pd_outb_end = nullptr;
}

void StampedStream::throw_marshal() { throw CORBA::MARSHAL(0, CORBA::COMPLETED_NO); }

// Alignment in CDR counts from the start of the message. The time takes 8 bytes, the largest alignment, so
// the body may be aligned as if it followed them, though it lies elsewhere.
std::byte* StampedStream::align_and_advance(void*& cursor, void*& end, std::size_t bytes,
                                            omni::alignment_t alignment) {
    if (in_time_ && cursor == end) {
        in_time_ = false;
        cursor = body_.data();
        end = body_.data() + body_.size();
    }
    const auto place = reinterpret_cast<omni::ptr_arith_t>(cursor);
    const auto padding = static_cast<std::size_t>(omni::align_to(place, alignment) - place);
    const std::size_t left = distance(cursor, end);
    // Subtracted, not added: the sum could overflow with a hostile length.
    if (padding > left || bytes > left - padding) throw_marshal();
    std::byte* const begin = byte_at(cursor) + padding;
    cursor = begin + bytes;
    return begin;
}

// ---- out

StampedOutStream::StampedOutStream(std::span<std::byte> body, bool timed) : StampedStream(body) {
    in_time_ = timed;
    pd_outb_mkr = timed ? time_ : body_.data();
    pd_outb_end = timed ? time_ + sizeof time_ : body_.data() + body_.size();
}

bool StampedOutStream::is_complete() const {
    return pd_outb_mkr == pd_outb_end && (!in_time_ || body_.empty());
}

std::size_t StampedOutStream::body_bytes() const {
    return in_time_ ? 0 : distance(body_.data(), pd_outb_mkr);
}

std::uint64_t StampedOutStream::packed_time() const {
    std::uint32_t words[2];
    std::memcpy(words, time_, sizeof words);
    return wire::pack_time(words[0], words[1]);
}

void StampedOutStream::put_octet_array(const _CORBA_Octet* from, int size, omni::alignment_t alignment) {
    const auto bytes = static_cast<std::size_t>(size);
    std::memcpy(align_and_advance(pd_outb_mkr, pd_outb_end, bytes, alignment), from, bytes);
}

// While the time is written, the whole body is still to come.
_CORBA_Boolean StampedOutStream::checkOutputOverrun(_CORBA_ULong size, _CORBA_ULong count,
                                                    omni::alignment_t) {
    const std::size_t body_left = in_time_ ? body_.size() : 0;
    return std::size_t{size} * count <= distance(pd_outb_mkr, pd_outb_end) + body_left;
}

// As if the body followed the time. An untimed message counts 8 bytes more, which changes no alignment.
_CORBA_ULong StampedOutStream::currentOutputPtr() const {
    return static_cast<_CORBA_ULong>(in_time_ ? distance(time_, pd_outb_mkr)
                                              : sizeof time_ + distance(body_.data(), pd_outb_mkr));
}

_CORBA_Boolean StampedOutStream::reserveOutputSpaceForPrimitiveType(omni::alignment_t alignment,
                                                                    std::size_t bytes) {
    pd_outb_mkr = align_and_advance(pd_outb_mkr, pd_outb_end, bytes, alignment);
    return true;
}

_CORBA_Boolean StampedOutStream::maybeReserveOutputSpace(omni::alignment_t alignment, std::size_t bytes) {
    return reserveOutputSpaceForPrimitiveType(alignment, bytes);
}

// ---- in

StampedInStream::StampedInStream(std::span<const std::byte> body, bool timed, std::uint64_t stamp)
    : StampedStream({byte_at(body.data()), body.size()}) {
    // The two words as CDR has them, so that the stream reads them like any other bytes.
    const std::uint32_t words[2] = {wire::stamp_seconds(stamp), wire::stamp_nanoseconds(stamp)};
    std::memcpy(time_, words, sizeof words);
    in_time_ = timed;
    pd_inb_mkr = timed ? time_ : body_.data();
    pd_inb_end = timed ? time_ + sizeof time_ : body_.data() + body_.size();
}

void StampedInStream::get_octet_array(_CORBA_Octet* to, int size, omni::alignment_t alignment) {
    const auto bytes = static_cast<std::size_t>(size);
    std::memcpy(to, align_and_advance(pd_inb_mkr, pd_inb_end, bytes, alignment), bytes);
}

void StampedInStream::skipInput(_CORBA_ULong size) {
    align_and_advance(pd_inb_mkr, pd_inb_end, size, omni::ALIGN_1);
}

_CORBA_Boolean StampedInStream::checkInputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) {
    const std::size_t body_left = in_time_ ? body_.size() : 0;
    return std::size_t{size} * count <= distance(pd_inb_mkr, pd_inb_end) + body_left;
}

_CORBA_ULong StampedInStream::currentInputPtr() const {
    return static_cast<_CORBA_ULong>(in_time_ ? distance(time_, pd_inb_mkr)
                                              : sizeof time_ + distance(body_.data(), pd_inb_mkr));
}

void StampedInStream::fetchInputData(omni::alignment_t alignment, std::size_t bytes) {
    pd_inb_mkr = align_and_advance(pd_inb_mkr, pd_inb_end, bytes, alignment);
}

} // namespace tandem::interceptor
