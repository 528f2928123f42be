// SPDX-License-Identifier: Apache-2.0
// LinkBuffer: messages that the ports of our engine marshal where they travel, and unmarshal from there.
#include "proxy/interceptor/data/link_buffer.hpp"

#ifndef TANDEM_RTM_PUBLIC_API

#include "proxy/wire/time.hpp"

#include <cstring>

namespace tandem::interceptor {

using RTC::BufferStatus;

static_assert(StampedStream::time_bytes == shm::payload_front);

[[gnu::hot]] BufferStatus LinkBuffer::writeInPlace(const RTC::Marshal& marshal) {
    if (!channel_.writer) return BufferStatus::PRECONDITION_NOT_MET;
    const auto pass = marshal.isWarmUp() ? shm::Pass::warm_up : shm::Pass::real;
    const RTC::TimedNumbers& numbers = marshal.numbers();
    if (numbers.tm && channel_.timed) { // then it is what marshalling would write behind the time
        std::uint32_t time[2];
        std::memcpy(time, numbers.tm, sizeof time);
        const auto sent =
            channel_.writer->write_numbers({numbers.elements, numbers.count, numbers.element_bytes},
                                           wire::pack_time(time[0], time[1]), pass);
        if (sent == link::ChannelWriter::Sent::yes) [[likely]]
            return BufferStatus::OK;
        if (sent == link::ChannelWriter::Sent::no) return write_status(false);
    } else if (!last_was_long_) {
        if (const auto status = write_short(marshal, pass)) return *status;
    }
    return marshal.isWarmUp() ? BufferStatus::OK : write_long(marshal);
}

// Marshals once, as most messages fit into a record. Nothing: this one does not, or the value cannot be marshalled.
[[gnu::hot]] std::optional<BufferStatus> LinkBuffer::write_short(const RTC::Marshal& marshal,
                                                                 shm::Pass pass) {
    std::uint64_t stamp = 0;
    bool fits = true;
    const bool written = channel_.writer->write_record(
        stamp,
        [&](std::span<std::byte> room) -> std::optional<std::size_t> {
            out_.open(room, channel_.timed, room.data() - shm::payload_front);
            fits = marshal(out_);
            if (!fits) return std::nullopt;
            stamp = channel_.timed ? out_.packed_time() : wire::wall_clock_stamp();
            return out_.body_bytes();
        },
        pass);
    if (!fits) return std::nullopt;
    return write_status(written);
}

// Marshals twice, the first time only for the length, to reserve exactly that in shared memory.
BufferStatus LinkBuffer::write_long(const RTC::Marshal& marshal) {
    const cdrMemoryStream default_stream; // for its code sets, which every serializer uses
    cdrCountingStream counter(default_stream.TCS_C(), default_stream.TCS_W());
    if (!marshal(counter)) return BufferStatus::NOT_SUPPORTED;
    const std::size_t body_bytes = counter.total() - (channel_.timed ? StampedStream::time_bytes : 0);
    last_was_long_ = body_bytes > channel_.writer->longest_record();
    std::uint64_t stamp = wire::wall_clock_stamp(); // of a timed message: replaced by its own time below
    bool complete = true;
    const bool written = channel_.writer->write_sized(body_bytes, stamp, [&](std::span<std::byte> room) {
        out_.open(room, channel_.timed);
        complete = marshal(out_) && out_.is_complete();
        if (channel_.timed) stamp = out_.packed_time();
        return complete;
    });
    return complete ? write_status(written) : BufferStatus::BUFFER_ERROR;
}

inline void LinkBuffer::decode_record(const shm::Record& record, RTC::Unmarshal& reader) {
    if (channel_.timed &&
        reader.take(wire::stamp_seconds(record.stamp_ns), wire::stamp_nanoseconds(record.stamp_ns),
                    reinterpret_cast<const unsigned char*>(record.bytes.data()), record.bytes.size()))
        return;
    in_.open(record.bytes, channel_.timed, record.stamp_ns, record.front);
    reader(in_);
}

[[gnu::always_inline]] inline bool LinkBuffer::read_record(RTC::Unmarshal& reader) {
    return channel_.reader->read_or_prepare(
        reader.isWarmUp(), [&](const shm::Record& record) { decode_record(record, reader); });
}

[[gnu::hot]] BufferStatus LinkBuffer::readInPlace(RTC::ByteData& message, RTC::Unmarshal& reader,
                                                  bool& read_in_place) {
    if (needs_copy() || !channel_.reader) [[unlikely]]
        return read_copy(message, reader, read_in_place);
    read_in_place = true;
    if (!read_record(reader)) return wait_for_record(reader);
    return reader.isWarmUp() ? BufferStatus::EMPTY : BufferStatus::OK; // a warm-up has taken none
}

[[gnu::noinline]] BufferStatus LinkBuffer::read_copy(RTC::ByteData& message, const RTC::Unmarshal& reader,
                                                     bool& read_in_place) {
    read_in_place = !needs_copy();
    if (read_in_place) return BufferStatus::PRECONDITION_NOT_MET;
    return reader.isWarmUp() ? BufferStatus::EMPTY : read(message, {});
}

/// As long as the policy asks, after a first look that has found nothing.
[[gnu::hot, gnu::noinline]] BufferStatus LinkBuffer::wait_for_record(RTC::Unmarshal& reader) {
    if (read_wait_.count() == 0 || reader.isWarmUp()) return BufferStatus::EMPTY;
    return read_or_wait([&] { return read_record(reader); });
}

} // namespace tandem::interceptor

#endif
