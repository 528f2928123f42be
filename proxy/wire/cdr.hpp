// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/spare_bytes.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

// CDR, the Common Data Representation of CORBA (OMG, CORBA 3.3 part 2, section 9.3): primitives in the sender's byte order,
// each aligned to its size, counted from the start of the message. Tandem writes only little endian, without an
// encapsulation header.
namespace tandem::wire {

static_assert(std::endian::native == std::endian::little,
              "primitives are copied in the machine's byte order");

/// A type whose CDR encoding is its memory representation, aligned to its size; long double is aligned to 8, as in omniORB.
/// wchar_t is not such a type: see wide_text.hpp.
template <class T>
concept CdrPrimitive = std::is_arithmetic_v<T> && !std::is_same_v<T, wchar_t>;
template <CdrPrimitive T>
constexpr std::size_t cdr_alignment = std::min<std::size_t>(sizeof(T), 8);

/// Copies like memcpy, even zero bytes. On AMD processors since Zen 3, memcpy of glibc before 2.40 takes 18 times as long
/// from 2 KiB to 1 MiB if the destination is 1 to 31 bytes after the source, modulo 4 KiB (glibc bug 30994). Memory for
/// a multiple of 4 KiB that is allocated directly after other such memory has this distance. In this case the copy is made
/// here, in blocks.
inline void copy_long(void* to, const void* from, std::size_t bytes) {
    const std::size_t behind =
        (reinterpret_cast<std::uintptr_t>(to) - reinterpret_cast<std::uintptr_t>(from)) % 4096;
    auto* out = static_cast<std::byte*>(to);
    const auto* in = static_cast<const std::byte*>(from);
    if (bytes >= 2048 && behind >= 1 && behind <= 31)
        for (std::array<std::byte, 64> block; bytes >= block.size(); bytes -= block.size()) {
            std::memcpy(block.data(), in, block.size());
            std::memcpy(out, block.data(), block.size());
            in += block.size();
            out += block.size();
        }
    if (bytes != 0) std::memcpy(out, in, bytes);
}

/// Copies like memcpy, for mostly short blocks: up to 128 bytes are copied here, without a loop, in blocks that may
/// overlap. A call takes more code than the copy, and cold code dominates the cost of a message.
inline void copy_block(void* to, const void* from, std::size_t bytes) {
    constexpr std::size_t word = sizeof(std::uint64_t), pair = 2 * word, max_short = 8 * pair;
    if (bytes < word || bytes > max_short) [[unlikely]] {
        copy_long(to, from, bytes);
        return;
    }
    auto* const out = static_cast<std::byte*>(to);
    const auto* const in = static_cast<const std::byte*>(from);
    if (bytes < pair) {
        std::memcpy(out, in, word);
        std::memcpy(out + bytes - word, in + bytes - word, word);
        return;
    }
    std::byte* const out_end = out + bytes;
    const std::byte* const in_end = in + bytes;
    if (bytes > 2 * pair) {
        if (bytes > 4 * pair) {
            std::memcpy(out + 2 * pair, in + 2 * pair, 2 * pair);
            std::memcpy(out_end - 4 * pair, in_end - 4 * pair, 2 * pair);
        }
        std::memcpy(out + pair, in + pair, pair);
        std::memcpy(out_end - 2 * pair, in_end - 2 * pair, pair);
    }
    std::memcpy(out, in, pair);
    std::memcpy(out_end - pair, in_end - pair, pair);
}

/// Returns the bytes before the first element of a sequence of numbers: the count, and padding to the alignment. Numbers
/// have 1, 2, 4 or 8 bytes, are neither bool nor wchar_t, and their bytes are their CDR.
constexpr std::size_t head_of_numbers(std::uint32_t element_bytes) {
    return std::max<std::size_t>(element_bytes, sizeof(std::uint32_t));
}

/// Memory for one message while it is needed, on the stack. A longer message takes the thread's spare memory.
class MessageBuffer {
  public:
    MessageBuffer() {} // NOLINT(modernize-use-equals-default): that would fill short_ in MessageBuffer{}
    ~MessageBuffer() {
        if (!longer_.empty()) [[unlikely]]
            give_back(std::move(longer_));
    }
    MessageBuffer(const MessageBuffer&) = delete;
    MessageBuffer& operator=(const MessageBuffer&) = delete;

    std::span<std::byte> memory() {
        return longer_.empty() ? std::span<std::byte>(short_, sizeof short_) : std::span<std::byte>(longer_);
    }
    /// Grows and keeps the content. For the CdrWriter that writes to this buffer.
    void grow(std::size_t bytes) {
        const std::size_t before = memory().size();
        if (longer_.empty()) {
            longer_ = take_spare_bytes();
            longer_.assign(short_, short_ + sizeof short_);
        }
        longer_.resize(std::max(bytes, 2 * before));
    }
    /// Returns the first `bytes` of the memory, which grows if necessary.
    std::span<std::byte> room_for(std::size_t bytes) {
        if (bytes > memory().size()) [[unlikely]]
            grow(bytes);
        return memory().first(bytes);
    }

  private:
    alignas(8) std::byte short_[512]; ///< not filled
    std::vector<std::byte> longer_;
};

/// Writes CDR into a span, a buffer or a vector. Beyond the end of a span nothing is written but size() keeps counting, so
/// that a caller learns how much room a message needs, as with snprintf. [one thread]
class CdrWriter {
  public:
    explicit CdrWriter(std::span<std::byte> out) : data_(out.data()), room_(out.size()) {}
    /// Writes to the start of `out`; written() returns the message.
    explicit CdrWriter(MessageBuffer& out) : CdrWriter(out.memory()) { buffer_ = &out; }
    /// Writes to `out`, whose length is always that of the message so far; for rare or long messages.
    explicit CdrWriter(std::vector<std::byte>& out) : vector_(&out) { out.clear(); }

    template <CdrPrimitive T>
    void put(T value) {
        if (size_ + max_padding + std::max(sizeof(T), sizeof(std::uint64_t)) > room_) [[unlikely]]
            return put_slowly(&value, sizeof(T), cdr_alignment<T>);
        skip_padding(cdr_alignment<T>);
        if constexpr (sizeof(T) < sizeof(std::uint64_t)) {
            std::uint64_t word = 0; // one store for the value and for zeros that may follow it
            std::memcpy(&word, &value, sizeof(T));
            std::memcpy(data_ + size_, &word, sizeof word);
        } else {
            std::memcpy(data_ + size_, &value, sizeof(T));
        }
        size_ += sizeof(T);
    }
    void put_bool(bool value) { put<std::uint8_t>(value ? 1 : 0); }

    /// Writes a CDR string: its length with the final NUL, the characters, the NUL.
    void put_string(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size() + 1));
        put_block(text.data(), text.size(), 1);
        put_block("", 1, 1);
    }
    /// Writes consecutive elements whose memory representation is their encoding, aligned to `alignment`.
    void put_block(const void* data, std::size_t bytes, std::size_t alignment) {
        if (bytes > room_ || size_ + 2 * max_padding > room_ - bytes) [[unlikely]]
            return put_slowly(data, bytes, alignment);
        skip_padding(alignment);
        copy_block(data_ + size_, data, bytes);
        size_ += bytes;
        const std::uint64_t zeros = 0;
        std::memcpy(data_ + size_, &zeros, sizeof zeros);
    }
    /// Writes a CDR sequence of `count` numbers: the count, and one block.
    template <CdrPrimitive T>
    void put_sequence(const T* numbers, std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes == 0 || bytes > room_ || size_ + 4 * max_padding > room_ - bytes) [[unlikely]]
            return put_sequence_slowly(numbers, count, bytes, cdr_alignment<T>);
        skip_padding(cdr_alignment<std::uint32_t>);
        const std::uint64_t count_and_zeros = count;
        std::memcpy(data_ + size_, &count_and_zeros, sizeof count_and_zeros);
        size_ += sizeof(std::uint32_t);
        skip_padding(cdr_alignment<T>);
        copy_block(data_ + size_, numbers, bytes);
        size_ += bytes;
        const std::uint64_t zeros = 0;
        std::memcpy(data_ + size_, &zeros, sizeof zeros);
    }
    /// Pads with zeros to a multiple of `alignment` (a power of two, 8 at most).
    void align(std::size_t alignment) { put_slowly(nullptr, 0, alignment); }

    /// Returns false if the message is longer than the span; then size() is the required length.
    bool fits() const { return vector_ || size_ <= room_; }
    std::size_t size() const { return size_; }
    /// Returns the message so far, if it fits().
    std::span<const std::byte> written() const { return {vector_ ? vector_->data() : data_, size_}; }

  private:
    static constexpr std::size_t max_padding = 8; // a word is stored

    // From size_ to the next multiple of 8 there are already zeros, wherever the fast functions wrote last.
    void skip_padding(std::size_t alignment) { size_ = (size_ + alignment - 1) & ~(alignment - 1); }

    /// Does the work of the other functions byte by byte: near the end, beyond it, or into a vector.
    void put_slowly(const void* data, std::size_t bytes, std::size_t alignment) {
        static constexpr std::byte zeros[8]{};
        const std::size_t padding = (0 - size_) & (alignment - 1);
        if (padding != 0) append(zeros, padding);
        append(data, bytes);
    }
    void put_sequence_slowly(const void* numbers, std::size_t count, std::size_t bytes,
                             std::size_t alignment) {
        put(static_cast<std::uint32_t>(count));
        if (bytes != 0) put_block(numbers, bytes, alignment);
    }
    void append(const void* data, std::size_t bytes) {
        if (buffer_ && size_ + bytes + 3 * max_padding > room_) {
            buffer_->grow(size_ + bytes + 3 * max_padding);
            data_ = buffer_->memory().data();
            room_ = buffer_->memory().size();
        }
        const auto* in = static_cast<const std::byte*>(data);
        if (vector_)
            vector_->insert(vector_->end(), in, in + bytes);
        else if (bytes != 0 && size_ + bytes <= room_)
            copy_long(data_ + size_, in, bytes);
        size_ += bytes;
        clear_word();
    }
    /// Used by the fast functions: writes zeros up to the next multiple of 8.
    void clear_word() {
        if (vector_) return;
        for (std::size_t at = size_; at % sizeof(std::uint64_t) != 0 && at < room_; ++at)
            data_[at] = std::byte{0};
    }

    std::byte* data_ = nullptr;
    std::size_t room_ = 0, size_ = 0;
    MessageBuffer* buffer_ = nullptr;          ///< grows; if null, data_ is all the memory
    std::vector<std::byte>* vector_ = nullptr; ///< grows; used instead of data_
};

/// Reads CDR that another process wrote and that may contain anything. After the first missing or wrong byte, ok() is false
/// and every read returns zero or nothing, so that a caller may check once, at the end. Never reads beyond the message.
/// [one thread]
class CdrReader {
  public:
    explicit CdrReader(std::span<const std::byte> in) : in_(in) {}

    template <CdrPrimitive T>
    T get() {
        T value{};
        if (align(cdr_alignment<T>) && skip(sizeof(T)))
            std::memcpy(&value, in_.data() + position_ - sizeof(T), sizeof(T));
        return value;
    }
    bool get_bool() {
        const auto value = get<std::uint8_t>();
        if (value > 1) ok_ = false; // a bool of any other value is undefined behaviour in C++
        return value == 1;
    }
    /// Reads the characters without the final NUL; valid as long as the message.
    std::string_view get_string() {
        const auto length = get<std::uint32_t>();
        if (length == 0) ok_ = false; // the length includes the final NUL
        if (!ok_ || !skip(length)) return {};
        const auto* text = reinterpret_cast<const char*>(in_.data() + position_ - length);
        if (text[length - 1] == '\0') return {text, length - 1};
        ok_ = false;
        return {};
    }
    /// Reads the count of a sequence whose elements take at least `element_bytes` each. A count that the rest of the
    /// message cannot hold is an error, so that no caller allocates memory for it.
    std::uint32_t get_count(std::size_t element_bytes) {
        const auto count = get<std::uint32_t>();
        if (ok_ && count <= remaining() / (element_bytes ? element_bytes : 1)) return count;
        ok_ = false;
        return 0;
    }
    /// Reads `bytes` bytes from the next multiple of `alignment`; empty if the message is too short.
    std::span<const std::byte> get_block(std::size_t bytes, std::size_t alignment) {
        if (!align(alignment) || !skip(bytes)) return {};
        return in_.subspan(position_ - bytes, bytes);
    }
    /// Reads the elements of a sequence, `element_bytes` each; empty if there are none or the message is too short.
    std::span<const std::byte> get_sequence(std::size_t element_bytes, std::size_t alignment) {
        const std::size_t head = (position_ + 3) & ~std::size_t{3},
                          behind_head = head + sizeof(std::uint32_t);
        if (ok_ && behind_head <= in_.size()) [[likely]] {
            std::uint32_t count = 0;
            std::memcpy(&count, in_.data() + head, sizeof count);
            const std::size_t begin =
                count == 0 ? behind_head : (behind_head + alignment - 1) & ~(alignment - 1);
            const std::size_t bytes = count * element_bytes;
            if (begin <= in_.size() && bytes <= in_.size() - begin) [[likely]] {
                position_ = begin + bytes;
                return {in_.data() + begin, bytes};
            }
        }
        ok_ = false;
        return {};
    }
    bool align(std::size_t alignment) { return skip((0 - position_) & (alignment - 1)); }

    bool ok() const { return ok_; }
    /// Sets ok() to false. For readers of their own format that find wrong bytes.
    void fail() { ok_ = false; }
    /// Continues reading at a position that was passed before.
    void seek(std::size_t position) { position_ = std::min(position, in_.size()); }
    std::size_t position() const { return position_; }
    std::size_t remaining() const { return in_.size() - position_; }

  private:
    bool skip(std::size_t bytes) {
        ok_ = ok_ && bytes <= remaining();
        if (ok_) position_ += bytes;
        return ok_;
    }

    std::span<const std::byte> in_;
    std::size_t position_ = 0;
    bool ok_ = true;
};

} // namespace tandem::wire
