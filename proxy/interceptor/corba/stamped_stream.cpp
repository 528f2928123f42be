// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/stamped_stream.hpp"

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/time.hpp"

#include <cstring>

namespace tandem::interceptor {
namespace {

std::byte* byte_at(const void* mark) { return const_cast<std::byte*>(static_cast<const std::byte*>(mark)); }

std::size_t distance(const void* from, const void* to) {
    return static_cast<std::size_t>(byte_at(to) - byte_at(from));
}

// Returns a stream with the code sets of strings, which a memory stream gets from the ORB. They never change in a process.
const cdrStream& stream_with_code_sets() {
    static const cdrMemoryStream stream;
    return stream;
}

} // namespace

StampedStream::StampedStream() {
    const cdrStream& known = stream_with_code_sets();
    TCS_C(known.TCS_C());
    TCS_W(known.TCS_W());
    // The peer runs on this machine: no bytes are swapped. The subclasses set the pointers of their direction.
    pd_marshal_byte_swap = pd_unmarshal_byte_swap = false;
    pd_inb_mkr = pd_inb_end = pd_outb_mkr = pd_outb_end = nullptr;
}

void StampedStream::throw_marshal() { throw CORBA::MARSHAL(0, CORBA::COMPLETED_NO); }

std::pair<void*, void*> StampedStream::open(std::span<std::byte> body, bool timed, std::byte* front) {
    body_ = body;
    time_ = front ? front : own_time_;
    in_time_ = timed && !front;
    std::byte* const end = body.data() + body.size();
    if (!timed) return {body.data(), end};
    return {time_, front ? end : time_ + time_bytes};
}

// Alignment in CDR counts from the start of the message. The time takes 8 bytes, the largest alignment, so
// the body may be aligned as if it followed them, although it is stored elsewhere.
void StampedStream::leave_time(void*& cursor, void*& end) {
    in_time_ = false;
    cursor = body_.data();
    end = body_.data() + body_.size();
}

// ---- out

bool StampedOutStream::is_complete() const {
    return pd_outb_mkr == pd_outb_end && (!in_time_ || body_.empty());
}

std::size_t StampedOutStream::body_bytes() const {
    return in_time_ || pd_outb_mkr < body_.data() ? 0 : distance(body_.data(), pd_outb_mkr);
}

std::uint64_t StampedOutStream::packed_time() const {
    std::uint32_t words[time_bytes / sizeof(std::uint32_t)];
    std::memcpy(words, time_, sizeof words);
    return wire::pack_time(words[0], words[1]);
}

void StampedOutStream::put_octet_array(const _CORBA_Octet* from, int size, omni::alignment_t alignment) {
    const auto bytes = static_cast<std::size_t>(size);
    wire::copy_block(align_and_advance(pd_outb_mkr, pd_outb_end, bytes, alignment), from, bytes);
}

// While the time is written, the whole body is still to come.
_CORBA_Boolean StampedOutStream::checkOutputOverrun(_CORBA_ULong size, _CORBA_ULong count,
                                                    omni::alignment_t) {
    const std::size_t body_left = in_time_ ? body_.size() : 0;
    return std::size_t{size} * count <= distance(pd_outb_mkr, pd_outb_end) + body_left;
}

// As if the body followed the time. An untimed message counts 8 bytes more, which changes no alignment.
StampedStream::Position StampedOutStream::currentOutputPtr() const {
    return static_cast<Position>(in_time_ ? distance(time_, pd_outb_mkr)
                                          : time_bytes + distance(body_.data(), pd_outb_mkr));
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

void StampedInStream::open(std::span<const std::byte> body, bool timed, std::uint64_t stamp,
                           std::byte* front) {
    std::tie(pd_inb_mkr, pd_inb_end) = StampedStream::open({byte_at(body.data()), body.size()}, timed, front);
    // The two words as CDR has them, so that the stream reads them like any other bytes.
    const std::uint32_t words[2] = {wire::stamp_seconds(stamp), wire::stamp_nanoseconds(stamp)};
    std::memcpy(time_, words, sizeof words);
}

void StampedInStream::get_octet_array(_CORBA_Octet* to, int size, omni::alignment_t alignment) {
    const auto bytes = static_cast<std::size_t>(size);
    wire::copy_block(to, align_and_advance(pd_inb_mkr, pd_inb_end, bytes, alignment), bytes);
}

void StampedInStream::skipInput(_CORBA_ULong size) {
    align_and_advance(pd_inb_mkr, pd_inb_end, size, omni::ALIGN_1);
}

_CORBA_Boolean StampedInStream::checkInputOverrun(_CORBA_ULong size, _CORBA_ULong count, omni::alignment_t) {
    const std::size_t body_left = in_time_ ? body_.size() : 0;
    return std::size_t{size} * count <= distance(pd_inb_mkr, pd_inb_end) + body_left;
}

StampedStream::Position StampedInStream::currentInputPtr() const {
    return static_cast<Position>(in_time_ ? distance(time_, pd_inb_mkr)
                                          : time_bytes + distance(body_.data(), pd_inb_mkr));
}

void StampedInStream::fetchInputData(omni::alignment_t alignment, std::size_t bytes) {
    pd_inb_mkr = align_and_advance(pd_inb_mkr, pd_inb_end, bytes, alignment);
}

} // namespace tandem::interceptor
