// SPDX-License-Identifier: Apache-2.0
// LinkBuffer: messages that the ports of our engine marshal where they travel, and unmarshal from there.
#include "proxy/interceptor/data/link_buffer.hpp"

#ifndef TANDEM_RTM_PUBLIC_API

#include "proxy/wire/time.hpp"

#include <cstring>

namespace tandem::interceptor {

using RTC::BufferStatus;

static_assert(StampedStream::time_bytes == shm::payload_front);

constexpr std::size_t shortest_long_message = std::size_t{64} * 1024;

BufferStatus LinkBuffer::writeInPlace(const RTC::Marshal& marshal) {
    if (!channel_.writer) return BufferStatus::PRECONDITION_NOT_MET;
    const auto& numbers = marshal.numbers();
    if (numbers.tm) { // then the channel is timed, and it is what marshalling would write after the time
        std::uint32_t time[2];
        std::memcpy(time, numbers.tm, sizeof time);
        const auto sent =
            channel_.writer->write_numbers({static_cast<const std::byte*>(numbers.elements),
                                            std::size_t{numbers.count} * numbers.element_bytes},
                                           numbers.element_bytes, wire::pack_time(time[0], time[1]));
        if (sent == link::ChannelWriter::Sent::yes) [[likely]]
            return BufferStatus::OK;
        if (sent == link::ChannelWriter::Sent::no) return write_status(false);
    } else if (!last_was_long_) {
        if (const auto status = write_short(marshal)) return *status;
    }
    return rt::rehearsing() ? BufferStatus::OK : write_long(marshal);
}

// Marshals once, because most messages fit into a record. Returns nothing if this one does not fit or the value cannot be
// marshalled.
std::optional<BufferStatus> LinkBuffer::write_short(const RTC::Marshal& marshal) {
    std::uint64_t stamp = 0;
    bool fits = true;
    const bool written =
        channel_.writer->write_record(stamp, [&](std::span<std::byte> room) -> std::optional<std::size_t> {
            out_.open(room, channel_.timed, room.data() - shm::payload_front);
            fits = marshal(out_);
            if (!fits) return std::nullopt;
            stamp = channel_.timed ? out_.packed_time() : wire::wall_clock_stamp();
            return out_.body_bytes();
        });
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

// Takes a message with as many numbers as the last one, as most have. Returns false, without side effects, for others.
inline bool copy_numbers(const shm::Record& record, const RTC::TimedNumbers<void>& to) {
    const std::size_t bytes = std::size_t{to.count} * to.element_bytes;
    const std::size_t head = wire::head_of_numbers(to.element_bytes);
    std::uint32_t count = 0;
    if (to.tm == nullptr || record.bytes.size() != head + bytes) return false;
    std::memcpy(&count, record.bytes.data(), sizeof count);
    if (count != to.count) return false;
    const std::uint32_t time[2] = {wire::stamp_seconds(record.stamp_ns),
                                   wire::stamp_nanoseconds(record.stamp_ns)};
    std::memcpy(to.tm, time, sizeof time);
    wire::copy_block(to.elements, record.bytes.data() + head, bytes);
    return true;
}

inline void LinkBuffer::decode_record(const shm::Record& record, RTC::Unmarshal& reader) {
    if (copy_numbers(record, reader.numbers())) [[likely]]
        return;
    in_.open(record.bytes, channel_.timed, record.stamp_ns, record.front);
    reader(in_);
}

inline bool LinkBuffer::read_record(RTC::Unmarshal& reader) {
    link::ChannelReader& channel = *in_place_;
    if (!channel.mutex().lock_unless_rehearsing()) return false;
    const rt::ShortLock lock(channel.mutex(), std::adopt_lock);
    const shm::Record* const record = channel.read_locked();
    if (!record) return false;
    decode_record(*record, reader);
    return true;
}

BufferStatus LinkBuffer::readInPlace(RTC::ByteData& message, RTC::Unmarshal& reader, bool& read_in_place) {
    read_in_place = in_place_ != nullptr;
    if (!read_in_place) [[unlikely]]
        return read_copy(message);
    if (!read_record(reader)) return read_nothing_new(reader);
    return BufferStatus::OK;
}

BufferStatus LinkBuffer::read_copy(RTC::ByteData& message) {
    if (!channel_.reader) return BufferStatus::PRECONDITION_NOT_MET;
    return rt::rehearsing() ? BufferStatus::EMPTY : read(message, {});
}

/// Called when the ring is empty. Depending on the policy, returns the last message again, or waits for a new one. As within a
/// host, a long message that is returned again leaves the component's variable unchanged.
BufferStatus LinkBuffer::read_nothing_new(RTC::Unmarshal& reader) {
    if (rt::rehearsing()) return BufferStatus::EMPTY;
    if (!readback_)
        return read_wait_.count() == 0 ? BufferStatus::EMPTY
                                       : read_or_wait([&] { return read_record(reader); });
    const rt::ShortLock lock(in_place_->mutex());
    const auto* const last = in_place_->again_locked();
    if (!last) return BufferStatus::EMPTY;
    if (last->bytes.size() < shortest_long_message) decode_record(*last, reader);
    return BufferStatus::OK;
}

} // namespace tandem::interceptor

#endif
