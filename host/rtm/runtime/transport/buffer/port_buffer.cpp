// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/buffer/port_buffer.hpp"
#include "host/rt/crossings.hpp"
#include "host/rt/cycle_lines.hpp"
#include "host/rt/rehearsal.hpp"
#include <algorithm>
#include <array>
#include <coil/stringutil.h>
#include <cstring>
#include <rtm/CopyBytes.h>
#include <rtm/idl/BasicDataTypeSkel.h>

namespace RTC {

using tandem::rt::CellRing;
using tandem::rt::cells_for;
using tandem::rt::rehearsing;
using tandem::rt::ShortLock;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t default_length = 8;
constexpr std::size_t longest_rehearsed =
    4096; // encoding more takes longer than the cache misses that it saves

constexpr bool native_little_endian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;
constexpr std::size_t time_bytes = sizeof(Time), count_bytes = sizeof(std::uint32_t);

/// A message in the buffer.
struct EncodedMessage {
    const unsigned char* bytes;
    std::size_t size;
    bool little_endian;
};

/// Returns the bytes before the numbers: time, count, and padding.
std::size_t head_bytes(std::uint32_t count, std::size_t element_bytes) {
    return time_bytes + count_bytes + (count > 0 && element_bytes == 8 ? 4 : 0);
}

std::size_t encoded_bytes(const TimedNumbers<const void>& numbers) {
    return head_bytes(numbers.count, numbers.element_bytes) +
           std::size_t{numbers.count} * numbers.element_bytes;
}

/// Writes encoded_bytes() to `out`.
void encode_numbers(const TimedNumbers<const void>& numbers, unsigned char* out) {
    const std::size_t head = head_bytes(numbers.count, numbers.element_bytes);
    const std::uint64_t count = numbers.count; // with the padding
    std::memcpy(out, numbers.tm, time_bytes);
    std::memcpy(out + time_bytes, &count, head - time_bytes);
    copyBytes(out + head, numbers.elements, std::size_t{numbers.count} * numbers.element_bytes);
}

bool are_block(const TimedNumbers<const void>& numbers) {
    return native_little_endian && numbers.tm != nullptr;
}

/// Returns false if the value cannot be encoded.
bool encode(const Marshal& marshal, cdrMemoryStream& stream, ByteData& to) {
    to.isLittleEndian(true);
    if (are_block(marshal.numbers())) {
        to.setDataLength(encoded_bytes(marshal.numbers()));
        encode_numbers(marshal.numbers(), to.getBuffer());
        return true;
    }
    stream.rewindPtrs();
    stream.setByteSwapFlag(true);
    if (!marshal(stream)) return false;
    to.writeData(static_cast<const unsigned char*>(stream.bufPtr()), stream.bufSize());
    return true;
}

/// Copies a message with as many numbers as the variable has, as most have. Returns false, without side effects, for
/// others.
bool decode_numbers(const EncodedMessage& from, const TimedNumbers<void>& to) {
    const std::size_t head = head_bytes(to.count, to.element_bytes),
                      bytes = std::size_t{to.count} * to.element_bytes;
    if (to.tm == nullptr || from.little_endian != native_little_endian || from.size != head + bytes)
        return false;
    const unsigned char* const in = from.bytes;
    std::uint32_t count = 0;
    std::memcpy(&count, in + time_bytes, sizeof count);
    if (count != to.count) return false;
    std::memcpy(to.tm, in, time_bytes);
    copyBytes(to.elements, in + head, bytes);
    return true;
}

void decode(const EncodedMessage& from, Unmarshal& reader) {
    if (decode_numbers(from, reader.numbers())) return;
    cdrMemoryStream stream(const_cast<unsigned char*>(from.bytes), from.size);
    stream.setByteSwapFlag(from.little_endian);
    reader(stream);
}

void copy(const EncodedMessage& from, ByteData& to) {
    to.writeData(from.bytes, from.size);
    to.isLittleEndian(from.little_endian);
}

using Ring = tandem::rt::ValueRing<ByteData>;

EncodedMessage as_message(const Ring::Content& value) { return {value.bytes(), value.size(), true}; }

/// Returns the message that was taken last from `cells`, which are the ring's or those of a rehearsal.
EncodedMessage last_message(const CellRing& cells, Ring& ring) {
    if (const auto* value = cells.taken_short()) return as_message(*value);
    const ByteData& last = ring.last();
    return {last.getBuffer(), last.getDataLength(), last.getEndian()};
}

/// Publishes the message in the writer's ByteData. Returns whether the oldest one was dropped for it.
bool publish_next(Ring& ring) {
    const ByteData& next = ring.next();
    const unsigned char* const bytes = next.getBuffer();
    if (next.getDataLength() <= Ring::Content::max_size && next.getEndian())
        return ring.publish_short(bytes, next.getDataLength());
    return ring.publish({&next, bytes, bytes + Ring::line, bytes});
}

void read_policy(const coil::Properties& prop, const char* key, const char* default_word,
                 bool& default_policy, bool& block) {
    const std::string policy = coil::normalize(prop.getProperty(key));
    if (policy.empty()) return;
    default_policy = policy == default_word;
    block = policy == "block";
}

} // namespace

PortBuffer::PortBuffer() : ring_(std::make_unique<Ring>(default_length)) {}

void PortBuffer::init(const coil::Properties& prop) {
    const std::scoped_lock lock(write_mutex_, read_mutex_);
    std::size_t n = 0;
    // A length from another process must not exhaust the memory. Ignores invalid lengths.
    if (coil::stringTo(n, prop.getProperty("length").c_str()) && n > 0 && n <= 1'000'000) set_length(n);
    read_policy(prop, "write.full_policy", "overwrite", overwrite_, block_write_);
    read_policy(prop, "read.empty_policy", "readback", readback_, block_read_);
    coil::stringTo(write_timeout_, prop.getProperty("write.timeout").c_str());
    coil::stringTo(read_timeout_, prop.getProperty("read.timeout").c_str());
}

std::size_t PortBuffer::length() const {
    const ShortLock lock(read_mutex_);
    return ring_->depth();
}

BufferStatus PortBuffer::length(std::size_t n) {
    if (n == 0 || n > Ring::max_depth) return BufferStatus::NOT_SUPPORTED;
    const std::scoped_lock lock(write_mutex_, read_mutex_);
    set_length(n);
    return BufferStatus::OK;
}

void PortBuffer::set_length(std::size_t n) {
    ring_ = std::make_unique<Ring>(n);
    has_last_ = false;
}

BufferStatus PortBuffer::reset() {
    const std::scoped_lock lock(write_mutex_, read_mutex_);
    while (ring_->take()) continue;
    has_last_ = false;
    return BufferStatus::OK;
}

/// Waits until ready() is true. The other end wakes this thread if its policy says that threads wait here; a thread that waits
/// against the policy checks at intervals.
template <class Ready>
bool PortBuffer::wait(std::chrono::nanoseconds timeout, const Ready& ready) {
    constexpr auto look = 10ms;
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    std::unique_lock lock(wait_mutex_);
    while (!ready()) {
        const auto now = std::chrono::steady_clock::now();
        if (now >= deadline) return false;
        changed_.wait_until(lock, std::min<std::chrono::steady_clock::time_point>(deadline, now + look));
    }
    return true;
}

// A waiting thread has checked the buffer with the mutex held, so it has seen the change or gets the notification.
void PortBuffer::wake() {
    { const std::lock_guard lock(wait_mutex_); }
    changed_.notify_all();
}

/// Returns FULL if there is no room, NOT_SUPPORTED if `publish` returns false.
template <class Publish>
inline BufferStatus PortBuffer::try_store(Turn& turn, const Publish& publish, bool& overwritten) {
    if (!write_mutex_.lock_unless_rehearsing()) return BufferStatus::OK;
    const ShortLock lock(write_mutex_, std::adopt_lock);
    turn.waits = turn.timeout > 0ns || (turn.timeout < 0ns && block_write_);
    turn.wakes = block_read_;
    if (turn.waits && turn.timeout < 0ns) turn.timeout = write_timeout_;
    if ((turn.waits || !overwrite_) && cells_for(*ring_).is_full()) return BufferStatus::FULL;
    return publish(overwritten) ? BufferStatus::OK : BufferStatus::NOT_SUPPORTED;
}

template <class Publish>
inline BufferStatus PortBuffer::store(std::chrono::nanoseconds timeout, const Publish& publish,
                                      bool& overwritten) {
    Turn turn{timeout};
    overwritten = false;
    BufferStatus status = try_store(turn, publish, overwritten);
    if (status == BufferStatus::FULL && turn.waits) {
        const auto stored = [&] {
            status = try_store(turn, publish, overwritten);
            return status != BufferStatus::FULL;
        };
        if (!wait(turn.timeout, stored)) return BufferStatus::TIMEOUT;
    }
    if (turn.wakes && status == BufferStatus::OK && !rehearsing()) wake();
    return status;
}

BufferStatus PortBuffer::write(const ByteData& message, std::chrono::nanoseconds timeout) {
    bool ignored = false;
    return store_copy(message, timeout, ignored);
}

BufferStatus PortBuffer::writeReporting(const ByteData& message, bool& overwritten) {
    return store_copy(message, -1ns, overwritten);
}

BufferStatus PortBuffer::store_copy(const ByteData& message, std::chrono::nanoseconds timeout,
                                    bool& overwritten) {
    const auto publish = [&](bool& dropped) {
        ring_->next() = message;
        dropped = publish_next(*ring_);
        return true;
    };
    return store(timeout, publish, overwritten);
}

BufferStatus PortBuffer::writeInPlace(const Marshal& marshal) {
    if (rehearsing() && !prepare_rehearsal_of_write()) return BufferStatus::OK;
    const auto publish = [&](bool& dropped) { return publish_encoded(marshal, dropped); };
    bool ignored = false;
    return store(-1ns, publish, ignored);
}

/// Encodes and publishes the message, in a rehearsal a short one only. Returns false if it cannot be encoded.
bool PortBuffer::publish_encoded(const Marshal& marshal, bool& dropped) {
    const auto& numbers = marshal.numbers();
    // The value of a rehearsal is short, even at a port for long ones.
    const bool is_long = rehearsing() && ring_->next().getBuffer() != nullptr;
    if (!is_long && are_block(numbers) && encoded_bytes(numbers) <= Ring::Content::max_size) {
        std::array<unsigned char, Ring::Content::max_size> bytes;
        encode_numbers(numbers, bytes.data());
        dropped = cells_for(*ring_).publish_short(bytes.data(), encoded_bytes(numbers));
        return true;
    }
    if (!encode(marshal, stream_, ring_->next())) return false;
    if (!rehearsing()) dropped = publish_next(*ring_);
    return true;
}

/// Returns whether the rehearsal goes on.
bool PortBuffer::prepare_rehearsal_of_write() {
    if (!write_mutex_.lock_if_owner()) return false;
    const ShortLock lock(write_mutex_, std::adopt_lock);
    tandem::rt::note_crossings(ring_->published());
    tandem::rt::rehearsal_ring().take(); // what the last rehearsal has published
    ring_->prefetch_for_publish();
    // Encoding the short message of a rehearsal would clear a long one.
    const ByteData& next = ring_->next();
    if (next.getDataLength() > longest_rehearsed) return false;
    __builtin_prefetch(next.getBuffer(), 1);
    return true;
}

/// Returns EMPTY if there is no message, even if threads wait for one.
template <class Decode>
inline BufferStatus PortBuffer::try_take(Turn& turn, const Decode& decode) {
    if (!read_mutex_.lock_unless_rehearsing()) return BufferStatus::EMPTY;
    const ShortLock lock(read_mutex_, std::adopt_lock);
    turn.waits = turn.timeout > 0ns || (turn.timeout < 0ns && block_read_);
    turn.wakes = block_write_;
    if (turn.waits && turn.timeout < 0ns) turn.timeout = read_timeout_;
    CellRing& cells = cells_for(*ring_);
    if (cells.take())
        has_last_ = has_last_ || !rehearsing();
    else if (turn.waits || !readback_ || !has_last_)
        return BufferStatus::EMPTY;
    decode(last_message(cells, *ring_));
    return BufferStatus::OK;
}

template <class Decode>
inline BufferStatus PortBuffer::take(std::chrono::nanoseconds timeout, const Decode& decode) {
    Turn turn{timeout};
    BufferStatus status = try_take(turn, decode);
    if (status == BufferStatus::EMPTY && turn.waits) {
        const auto taken = [&] { return (status = try_take(turn, decode)) == BufferStatus::OK; };
        if (!wait(turn.timeout, taken)) return BufferStatus::TIMEOUT;
    }
    if (turn.wakes && status == BufferStatus::OK && !rehearsing()) wake();
    return status;
}

BufferStatus PortBuffer::read(ByteData& message, std::chrono::nanoseconds timeout) {
    return take(timeout, [&](const EncodedMessage& from) { copy(from, message); });
}

BufferStatus PortBuffer::readInPlace(ByteData&, Unmarshal& reader, bool& read_in_place) {
    read_in_place = true;
    if (rehearsing() && !prepare_rehearsal_of_read(reader)) return BufferStatus::EMPTY;
    return take(-1ns, [&](const EncodedMessage& from) { decode(from, reader); });
}

/// Gives the rehearsal the last message to take once more. Only decodes it if it is not a short one. Returns whether the
/// rehearsal goes on.
bool PortBuffer::prepare_rehearsal_of_read(Unmarshal& reader) {
    if (!read_mutex_.lock_if_owner()) return false;
    const ShortLock lock(read_mutex_, std::adopt_lock);
    tandem::rt::note_crossings(ring_->taken());
    ring_->prefetch_for_take();
    if (!has_last_) return false;
    const EncodedMessage last = last_message(*ring_, *ring_);
    if (ring_->taken_short() != nullptr) {
        tandem::rt::rehearsal_ring().take();
        tandem::rt::rehearsal_ring().publish_short(last.bytes, last.size);
        return true;
    }
    if (last.size <= longest_rehearsed) decode(last, reader);
    return false;
}

// Unlike readable(), looks at no line that the writer writes for each message.
bool PortBuffer::empty() const {
    const ShortLock lock(read_mutex_);
    return ring_->empty();
}

std::size_t PortBuffer::readable() const {
    const ShortLock lock(read_mutex_);
    return ring_->empty() ? 0
                          : std::max<std::size_t>(ring_->size(), 1); // the cell is filled before the count
}

void PortBuffer::note_lines() const {
    if (!read_mutex_.lock_if_owner()) return;
    const ShortLock lock(read_mutex_, std::adopt_lock);
    tandem::rt::note_lines(&ring_, cache_line);
    tandem::rt::note_lines(&read_mutex_, cache_line);
    ring_->note_lines_of_empty();
}

std::size_t PortBuffer::writable() const {
    const ShortLock lock(read_mutex_);
    return ring_->depth() - ring_->size();
}

/// Gives each short message a ByteData, and counts dropped ones as read. Call it with both mutexes held, before an access by offset.
void PortBuffer::settle() {
    ring_->settle([this](std::uint32_t index, const Ring::Content& value) {
        copy(as_message(value), ring_->at(index));
    });
}

ByteData* PortBuffer::wptr(long n) {
    const std::scoped_lock lock(write_mutex_, read_mutex_);
    settle();
    return &ring_->at(ring_->writers(n));
}

BufferStatus PortBuffer::advanceWptr(long n, bool /*unlock_enable*/) {
    {
        const std::scoped_lock lock(write_mutex_, read_mutex_);
        settle();
        const long filled = static_cast<long>(ring_->size()), depth = static_cast<long>(ring_->depth());
        if (n > depth - filled || n < -filled) return BufferStatus::PRECONDITION_NOT_MET;
        for (; n > 0; --n) ring_->publish();
        for (; n < 0; ++n) ring_->unpublish();
    }
    wake();
    return BufferStatus::OK;
}

BufferStatus PortBuffer::put(const ByteData& message) {
    const ShortLock lock(write_mutex_);
    ring_->next() = message;
    return BufferStatus::OK;
}

ByteData* PortBuffer::rptr(long n) {
    const std::scoped_lock lock(write_mutex_, read_mutex_);
    settle();
    return &ring_->at(ring_->readers(n));
}

BufferStatus PortBuffer::advanceRptr(long n, bool /*unlock_enable*/) {
    {
        const std::scoped_lock lock(write_mutex_, read_mutex_);
        settle();
        const long filled = static_cast<long>(ring_->size()), depth = static_cast<long>(ring_->depth());
        if (n > filled || n < filled - depth) return BufferStatus::PRECONDITION_NOT_MET;
        has_last_ = has_last_ || n > 0;
        for (; n > 0; --n) ring_->take();
        for (; n < 0; ++n) ring_->untake();
    }
    wake();
    return BufferStatus::OK;
}

BufferStatus PortBuffer::get(ByteData& message) {
    const std::scoped_lock lock(write_mutex_, read_mutex_);
    settle();
    message = ring_->at(ring_->readers(0));
    return BufferStatus::OK;
}

ByteData& PortBuffer::get() { return *rptr(0); }

} // namespace RTC
