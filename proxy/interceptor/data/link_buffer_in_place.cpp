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
    if (!last_was_long_) {
        const bool has_numbers = channel_.timed && marshal.numbers().tm;
        const auto pass = marshal.isWarmUp() ? shm::Pass::warm_up : shm::Pass::real;
        if (const auto status =
                has_numbers ? write_numbers(marshal.numbers(), pass) : write_short(marshal, pass))
            return *status;
    }
    return marshal.isWarmUp() ? BufferStatus::OK : write_long(marshal);
}

// What marshalling would write behind the time. Nothing: it does not fit into a record.
[[gnu::hot]] std::optional<BufferStatus> LinkBuffer::write_numbers(const RTC::TimedNumbers& numbers,
                                                                   shm::Pass pass) {
    std::uint32_t time[2];
    std::memcpy(time, numbers.tm, sizeof time);
    const std::uint64_t stamp = wire::pack_time(time[0], time[1]);
    const std::uint64_t count_and_zeros = numbers.count;
    const std::size_t bytes = std::size_t{numbers.count} * numbers.element_bytes;
    const std::size_t head = bytes != 0 && numbers.element_bytes > sizeof numbers.count
                                 ? sizeof count_and_zeros
                                 : sizeof numbers.count;
    bool fits = true;
    const bool written = channel_.writer->write_record(
        stamp,
        [&](std::span<std::byte> room) -> std::optional<std::size_t> {
            fits = head + bytes <= room.size() && room.size() >= sizeof count_and_zeros;
            if (!fits) return std::nullopt;
            std::memcpy(room.data(), &count_and_zeros, sizeof count_and_zeros);
            wire::copy_block(room.data() + head, numbers.elements, bytes);
            return head + bytes;
        },
        pass);
    if (!fits) return std::nullopt;
    return write_status(written);
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

[[gnu::hot]] BufferStatus LinkBuffer::readInPlace(RTC::ByteData& message, RTC::Unmarshal& reader,
                                                  bool& read_in_place) {
    read_in_place = !needs_copy();
    if (!read_in_place) return reader.isWarmUp() ? BufferStatus::EMPTY : read(message, {});
    if (!channel_.reader) return BufferStatus::PRECONDITION_NOT_MET;
    const auto decode = [&](const shm::Record& record) { decode_record(record, reader); };
    if (reader.isWarmUp())
        return channel_.reader->read_again(decode) ? BufferStatus::OK : BufferStatus::EMPTY;
    return read_or_wait([&] { return channel_.reader->read(false, decode); });
}

// Out of line: the copy in the warm-up would warm up itself only.
[[gnu::hot, gnu::noinline]] void LinkBuffer::decode_record(const shm::Record& record,
                                                           RTC::Unmarshal& reader) {
    if (channel_.timed &&
        reader.take(wire::stamp_seconds(record.stamp_ns), wire::stamp_nanoseconds(record.stamp_ns),
                    reinterpret_cast<const unsigned char*>(record.bytes.data()), record.bytes.size()))
        return;
    in_.open(record.bytes, channel_.timed, record.stamp_ns, record.front);
    reader(in_);
}

} // namespace tandem::interceptor

#endif
