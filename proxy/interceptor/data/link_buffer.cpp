// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/data/link_buffer.hpp"

#include "host/log/log.hpp"
#include "proxy/interceptor/corba/refused_value.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"

#include <coil/stringutil.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>

namespace tandem::interceptor {
namespace {

using RTC::BufferStatus;

constexpr std::size_t time_bytes = StampedStream::time_bytes;
constexpr double max_read_wait_s = 10; // a cycle that waits longer looks like one that hangs

// The buffer factory creates buffers without arguments. A new buffer finds its channel here, by a property of
// its connector.
std::mutex channels_mutex;
std::map<std::string, LinkChannel>& channels() {
    static std::map<std::string, LinkChannel> channels;
    return channels;
}

/// With channels_mutex held. A key is LINK/PORT#NUMBER with the number of the port's type, or LINK/PORT for the newest type,
/// which senders in other processes use. Returns nullptr if the key is not registered.
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
    // Settings of the port in rtc.conf, and OpenRTM's defaults; those for a full buffer are the channel's.
    const std::string empty_policy = coil::normalize(properties.getProperty("read.empty_policy"));
    readback_ = empty_policy.empty() || empty_policy == "readback";
    double timeout_s = 1;
    coil::stringTo(timeout_s, properties.getProperty("read.timeout").c_str());
    if (empty_policy == "block" && timeout_s > 0)
        read_wait_ =
            std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * std::min(timeout_s, max_read_wait_s)));
    const std::lock_guard lock(channels_mutex);
    // A key that is not registered leaves both ends empty: write() and read() then say PRECONDITION_NOT_MET.
    if (const auto* found = find_channel(properties.getProperty("channel"))) channel_ = *found;
    in_place_ = channel_.transcoded ? nullptr : channel_.reader;
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
    } catch (const CORBA::SystemException& error) { // the type allows this value, but the link does not
        channel_.writer->refuse(reason_of(error));
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

BufferStatus LinkBuffer::read(RTC::ByteData& message, std::chrono::nanoseconds) {
    if (!channel_.reader) return BufferStatus::PRECONDITION_NOT_MET;
    BufferStatus status = BufferStatus::OK;
    // false: messages in their order, as RTM's own ring buffer returns them.
    const auto found = read_or_wait([&] {
        return channel_.reader->read(
            false, [&](const shm::Record& record) { status = copy_message(record, message); });
    });
    if (found == BufferStatus::OK) {
        has_last_ = status == BufferStatus::OK;
        return status;
    }
    if (!readback_ || !has_last_) return found;
    const rt::ShortLock lock(channel_.reader->mutex());
    const auto* const last = channel_.reader->again_locked();
    return last ? copy_message(*last, message) : found;
}

BufferStatus LinkBuffer::copy_message(const shm::Record& record, RTC::ByteData& message) {
    std::span<const std::byte> body = record.bytes;
    std::optional<cdrMemoryStream> stream; // none for the usual types: it would allocate
    if (channel_.transcoded) {
        try {
            wire::CdrReader in(snapshot_.of(record));
            from_cdr(*channel_.transcoded, in, stream.emplace());
        } catch (const CORBA::SystemException& error) {  // the peer is another process
            channel_.reader->count_undecodable_locked(); // read() has the lock
            if (undecodable_.should_log())
                log::error(
                    "a message of {} bytes from the link does not decode ({}) and is dropped, {} so far",
                    record.bytes.size(), reason_of(error), undecodable_.count());
            return BufferStatus::BUFFER_ERROR;
        }
        body = {static_cast<const std::byte*>(stream->bufPtr()), stream->bufSize()};
    }
    // Restores RTM's time before the payload, because the port expects a message of the RTC's type.
    const std::size_t head = channel_.timed ? time_bytes : 0;
    message.setDataLength(head + body.size());
    message.isLittleEndian(true);
    auto* const out = reinterpret_cast<std::byte*>(message.getBuffer());
    if (channel_.timed) {
        const std::uint32_t time[] = {wire::stamp_seconds(record.stamp_ns),
                                      wire::stamp_nanoseconds(record.stamp_ns)};
        static_assert(sizeof time == time_bytes);
        std::memcpy(out, time, sizeof time);
    }
    wire::copy_block(out + head, body.data(), body.size());
    return BufferStatus::OK;
}

std::size_t LinkBuffer::readable() const { return channel_.reader && !channel_.reader->empty() ? 1 : 0; }

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
