// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// CDR, the Common Data Representation of CORBA (OMG, CORBA 3.3 part 2, section 9.3): primitives in the byte
// order of the sender, each aligned to its size, counted from the start of the message. Tandem writes little
// endian only, and no encapsulation header.
namespace tandem::wire {

static_assert(std::endian::native == std::endian::little,
              "primitives are copied in the machine's byte order");

/// A type whose CDR encoding is its memory representation, aligned to its size; of long double: to 8, as omniORB does.
/// wchar_t is none: see wide_text.hpp.
template <class T>
concept CdrPrimitive = std::is_arithmetic_v<T> && !std::is_same_v<T, wchar_t>;
template <CdrPrimitive T>
constexpr std::size_t cdr_alignment = std::min<std::size_t>(sizeof(T), 8);

/// Writes CDR, into a span or a growing vector. Beyond the end of a span nothing is written but size() goes
/// on counting: so a caller learns how much room a message needs, as with snprintf. [one thread]
class CdrWriter {
  public:
    explicit CdrWriter(std::span<std::byte> out) : out_(out) {}
    /// Writes to the start of `out`, which grows with the message and keeps its capacity for the next one.
    explicit CdrWriter(std::vector<std::byte>& out) : vector_(&out) { out.clear(); }

    template <CdrPrimitive T>
    void put(T value) {
        align(cdr_alignment<T>);
        if (vector_ || size_ + sizeof(T) > out_.size()) return append(&value, sizeof(T));
        std::memcpy(out_.data() + size_, &value, sizeof(T)); // of known length: one store
        size_ += sizeof(T);
    }
    void put_bool(bool value) { put<std::uint8_t>(value ? 1 : 0); }

    /// A CDR string: its length with the final NUL, the characters, the NUL.
    void put_string(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size() + 1));
        append(text.data(), text.size());
        append("", 1);
    }
    /// Consecutive elements whose memory representation is their encoding, aligned to `alignment`.
    void put_block(const void* data, std::size_t bytes, std::size_t alignment) {
        align(alignment);
        append(data, bytes);
    }
    /// Pads with zeros to a multiple of `alignment` (a power of two).
    void align(std::size_t alignment) {
        static constexpr std::byte zeros[8]{};
        if (const std::size_t padding = (0 - size_) & (alignment - 1)) append(zeros, padding);
    }

    /// False if the message is longer than the span; then size() says how long it is.
    bool fits() const { return vector_ || size_ <= out_.size(); }
    std::size_t size() const { return size_; }

  private:
    void append(const void* data, std::size_t bytes) {
        if (vector_) {
            vector_->resize(size_ + bytes);
            std::copy_n(static_cast<const std::byte*>(data), bytes, vector_->data() + size_);
        } else if (bytes != 0 && size_ + bytes <= out_.size()) {
            std::memcpy(out_.data() + size_, data, bytes);
        }
        size_ += bytes;
    }

    std::span<std::byte> out_;
    std::vector<std::byte>* vector_ = nullptr; ///< grows; if null, out_ is used
    std::size_t size_ = 0;
};

/// Reads CDR that another process wrote and that may hold anything. After the first byte that is missing or
/// wrong, ok() is false and every read returns zero or nothing, so that a caller may check once, at the end;
/// nothing beyond the message is ever read. [one thread]
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
    /// The characters without the final NUL, valid as long as the message.
    std::string_view get_string() {
        const auto length = get<std::uint32_t>();
        if (length == 0) ok_ = false; // the final NUL counts
        if (!ok_ || !skip(length)) return {};
        const auto* text = reinterpret_cast<const char*>(in_.data() + position_ - length);
        if (text[length - 1] == '\0') return {text, length - 1};
        ok_ = false;
        return {};
    }
    /// The count of a sequence whose elements take at least `element_bytes` each. A count that the rest of the
    /// message cannot hold is an error, so that no caller allocates for it.
    std::uint32_t get_count(std::size_t element_bytes) {
        const auto count = get<std::uint32_t>();
        if (ok_ && count <= remaining() / (element_bytes ? element_bytes : 1)) return count;
        ok_ = false;
        return 0;
    }
    /// The next `bytes` bytes from a multiple of `alignment` on; empty when the message ends before.
    std::span<const std::byte> get_block(std::size_t bytes, std::size_t alignment) {
        if (!align(alignment) || !skip(bytes)) return {};
        return in_.subspan(position_ - bytes, bytes);
    }
    bool align(std::size_t alignment) { return skip((0 - position_) & (alignment - 1)); }

    bool ok() const { return ok_; }
    /// For what reads a format of its own: the bytes are wrong, so ok() is false from here on.
    void fail() { ok_ = false; }
    /// Goes on reading at a position that was passed before.
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
