// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/data/link_buffer.hpp"

#include "proxy/interceptor/corba/transcoder.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

namespace tandem::interceptor {
namespace {

using RTC::BufferStatus;

constexpr std::size_t time_bytes = StampedStream::time_bytes;
static_assert(time_bytes == shm::payload_front);
constexpr double max_read_wait_s = 10; // a cycle that waits longer looks like one that hangs

// The buffer factory creates buffers without arguments. A new buffer finds its channel here, by a property of
// its connector.
std::mutex channels_mutex;
std::map<std::string, LinkChannel>& channels() {
    static std::map<std::string, LinkChannel> channels;
    return channels;
}

/// With channels_mutex held. A key is LINK/PORT#NUMBER, the number being that of the port's type; LINK/PORT is the newest type's,
/// for senders in other processes. nullptr: it is not registered.
const LinkChannel* find_channel(const std::string& key) {
    const auto& all = channels();
    if (const auto found = all.find(key); found != all.end()) return &found->second;
    const std::string prefix = key + "#";
    const std::string* newest_key = nullptr;
    const LinkChannel* newest = nullptr;
    for (auto at = all.lower_bound(prefix); at != all.end() && at->first.rfind(prefix, 0) == 0; ++at) {
        if (newest_key && at->first.size() < newest_key->size()) continue; // #10 comes before #9
        newest_key = &at->first;
        newest = &at->second;
    }
    return newest;
}

} // namespace

LinkChannel make_link_channel(const wire::Type& message) {
    LinkChannel channel;
    channel.timed = wire::is_timed(message);
    if (wire::contains(message, wire::Kind::any) || wire::contains(message, wire::Kind::fixed))
        channel.transcoded =
            std::make_shared<const wire::Type>(channel.timed ? wire::without_time(message) : message);
    return channel;
}

void LinkBuffer::register_factory() {
    RTC::CdrBufferFactory::instance().addFactory(factory_name, coil::Creator<RTC::CdrBufferBase, LinkBuffer>,
                                                 coil::Destructor<RTC::CdrBufferBase, LinkBuffer>);
}

void LinkBuffer::register_channel(const std::string& key, const LinkChannel& channel) {
    const std::lock_guard lock(channels_mutex);
    channels()[key] = channel;
}

void LinkBuffer::unregister_channel(const std::string& key) {
    const std::lock_guard lock(channels_mutex);
    channels().erase(key);
}

void LinkBuffer::init(const coil::Properties& properties) {
    // Settings of the port in rtc.conf; those for a full buffer are the writer's, which is the peer.
    const std::string empty_policy = coil::normalize(properties.getProperty("read.empty_policy"));
    readback_ = empty_policy == "readback";
    double timeout_s = 1; // OpenRTM's default
    coil::stringTo(timeout_s, properties.getProperty("read.timeout").c_str());
    if (empty_policy == "block" && timeout_s > 0)
        read_wait_ =
            std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * std::min(timeout_s, max_read_wait_s)));
    const std::lock_guard lock(channels_mutex);
    // A key that is not registered leaves both ends empty: write() and read() then say PRECONDITION_NOT_MET.
    if (const auto* found = find_channel(properties.getProperty("channel"))) channel_ = *found;
}

BufferStatus LinkBuffer::write(const RTC::ByteData& message, std::chrono::nanoseconds) {
    if (!channel_.writer) return BufferStatus::PRECONDITION_NOT_MET;
    // The RTC's serializer has put RTM's time in front; it travels in the record's header instead.
    auto bytes = std::as_bytes(std::span(message.getBuffer(), message.getDataLength()));
    std::uint64_t stamp = 0;
    if (channel_.timed) {
        wire::CdrReader time(bytes);
        const auto sec = time.get<std::uint32_t>(), nsec = time.get<std::uint32_t>();
        if (!time.ok()) return BufferStatus::BUFFER_ERROR;
        stamp = wire::pack_time(sec, nsec);
        bytes = bytes.subspan(time_bytes);
    } else {
        stamp = wire::wall_clock_stamp();
    }
    try {
        return write_body(channel_.transcoded ? transcode_to_link(bytes) : bytes, stamp);
    } catch (const CORBA::SystemException& error) { // a value that the type allows and the link does not
        channel_.writer->refuse(error._name());
        return BufferStatus::BUFFER_ERROR;
    }
}

BufferStatus LinkBuffer::write_body(std::span<const std::byte> body, std::uint64_t stamp) {
    return write_status(channel_.writer->write_sized(body.size(), stamp, [&](std::span<std::byte> room) {
        std::copy(body.begin(), body.end(), room.begin());
        return true;
    }));
}

/// Throws CORBA::SystemException.
std::span<const std::byte> LinkBuffer::transcode_to_link(std::span<const std::byte> body) {
    StampedInStream in(body, false, 0); // the time is 8 bytes long, which changes no alignment
    wire::CdrWriter out(transcoded_);
    to_cdr(*channel_.transcoded, in, out);
    return transcoded_;
}

/// Without a peer the message is dropped, and the RTC gets the same status as with an unconnected
/// port, so that its write() does not fail while the other host is restarted.
[[gnu::hot]] BufferStatus LinkBuffer::write_status(bool written) const {
    return written || !channel_.writer->is_bound() ? BufferStatus::OK : BufferStatus::FULL;
}

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
    const std::size_t body_bytes = counter.total() - (channel_.timed ? time_bytes : 0);
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

/// `read_one` returns whether there was a message.
template <class Read>
BufferStatus LinkBuffer::read_or_wait(Read&& read_one) {
    constexpr auto pause = std::chrono::microseconds(200);
    if (read_one()) return BufferStatus::OK;
    if (read_wait_.count() == 0) return BufferStatus::EMPTY;
    const auto deadline = std::chrono::steady_clock::now() + read_wait_;
    while (std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(pause);
        if (read_one()) return BufferStatus::OK;
    }
    return BufferStatus::TIMEOUT;
}

BufferStatus LinkBuffer::read(RTC::ByteData& message, std::chrono::nanoseconds) {
    if (!channel_.reader) return BufferStatus::PRECONDITION_NOT_MET;
    BufferStatus status = BufferStatus::OK;
    // false: messages in their order, as RTM's own ring buffer returns them.
    const auto found = read_or_wait([&] {
        return channel_.reader->read(
            false, [&](const shm::Record& record) { status = copy_message(record, message); });
    });
    if (!readback_) return found == BufferStatus::OK ? status : found;
    if (found == BufferStatus::OK && status == BufferStatus::OK) {
        last_ = message;
        has_last_ = true;
    } else if (found != BufferStatus::OK && has_last_) {
        message = last_;
        return BufferStatus::OK;
    }
    return found == BufferStatus::OK ? status : found;
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

BufferStatus LinkBuffer::copy_message(const shm::Record& record, RTC::ByteData& message) {
    std::span<const std::byte> body = record.bytes;
    std::optional<cdrMemoryStream> stream; // none for the usual types: it would allocate
    if (channel_.transcoded) {
        try {
            wire::CdrReader in(record.bytes);
            from_cdr(*channel_.transcoded, in, stream.emplace());
        } catch (const CORBA::SystemException& error) {  // the peer is another process
            channel_.reader->count_undecodable_locked(); // read() has the lock
            if (undecodable_.should_log())
                spdlog::error(
                    "a message of {} bytes from the link does not decode ({}) and is dropped, {} so far",
                    record.bytes.size(), error._name(), undecodable_.count());
            return BufferStatus::BUFFER_ERROR;
        }
        body = {static_cast<const std::byte*>(stream->bufPtr()), stream->bufSize()};
    }
    // RTM's time is put back in front of the payload: the port expects the message as its type has it.
    const std::size_t head = channel_.timed ? time_bytes : 0;
    message.setDataLength(head + body.size());
    message.isLittleEndian(true);
    auto* out = reinterpret_cast<std::byte*>(message.getBuffer());
    wire::CdrWriter writer(std::span(out, message.getDataLength()));
    if (channel_.timed) {
        writer.put(wire::stamp_seconds(record.stamp_ns));
        writer.put(wire::stamp_nanoseconds(record.stamp_ns));
    }
    writer.put_block(body.data(), body.size(), 1);
    return BufferStatus::OK;
}

[[gnu::hot]] std::size_t LinkBuffer::readable() const {
    return channel_.reader && !channel_.reader->empty() ? 1 : 0;
}

RTC::ByteData& LinkBuffer::get() {
    read(last_, {}); // if there is none, last_ stays as it was
    return last_;
}

BufferStatus LinkBuffer::reset() {
    // Reading the newest message skips all older ones.
    if (channel_.reader) channel_.reader->read(true, [](const shm::Record&) {});
    return BufferStatus::OK;
}

} // namespace tandem::interceptor
