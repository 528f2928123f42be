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

namespace tandem::wire {

static_assert(std::endian::native == std::endian::little, "CDR is written as the machine has it");

/// A value that CDR writes as it lies in memory, aligned to its size.
template <class T>
concept CdrPrimitive = std::is_arithmetic_v<T> && sizeof(T) <= 8;

/// Writes CDR into a buffer of fixed size. Past its end nothing is written but size() goes on counting, so
/// that a caller learns how much room the message needs.
class CdrWriter {
  public:
    explicit CdrWriter(std::span<std::byte> out) : out_(out) {}
    /// Writes from the start of `out`, which grows as the message does and keeps its capacity.
    explicit CdrWriter(std::vector<std::byte>& out) : grow_(&out) { out.clear(); }

    template <CdrPrimitive T>
    void put(T value) {
        align(sizeof(T));
        append(&value, sizeof(T));
    }
    void put_bool(bool value) { put<std::uint8_t>(value ? 1 : 0); }

    /// Length including the final NUL, the characters, the NUL.
    void put_string(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size() + 1));
        append(text.data(), text.size());
        append("", 1);
    }
    /// Elements that lie in a row, aligned to `alignment`.
    void put_block(const void* data, std::size_t bytes, std::size_t alignment) {
        align(alignment);
        append(data, bytes);
    }
    /// Pads with zeros to a multiple of `alignment` (a power of two).
    void align(std::size_t alignment) {
        static constexpr std::byte zeros[8]{};
        append(zeros, (0 - size_) & (alignment - 1));
    }

    bool fits() const { return grow_ || size_ <= out_.size(); }
    std::size_t size() const { return size_; }

  private:
    void append(const void* data, std::size_t bytes) {
        if (grow_) {
            grow_->resize(size_ + bytes);
            std::copy_n(static_cast<const std::byte*>(data), bytes, grow_->data() + size_);
        } else if (bytes != 0 && size_ + bytes <= out_.size()) {
            std::memcpy(out_.data() + size_, data, bytes);
        }
        size_ += bytes;
    }

    std::span<std::byte> out_;
    std::vector<std::byte>* grow_ = nullptr;
    std::size_t size_ = 0;
};

/// Reads CDR. After the first byte that is missing or wrong, ok() is false and every read gives zero or
/// nothing: a reader of a hostile message ends, it does not crash.
class CdrReader {
  public:
    explicit CdrReader(std::span<const std::byte> in) : in_(in) {}

    template <CdrPrimitive T>
    T get() {
        T value{};
        if (align(sizeof(T)) && take(sizeof(T))) std::memcpy(&value, in_.data() + at_ - sizeof(T), sizeof(T));
        return value;
    }
    bool get_bool() {
        const auto value = get<std::uint8_t>();
        if (value > 1) fail();
        return value == 1;
    }
    /// The characters without the final NUL, valid as long as the message.
    std::string_view get_string() {
        const auto length = get<std::uint32_t>();
        if (length == 0 || !take(length)) return fail(), std::string_view();
        const auto* text = reinterpret_cast<const char*>(in_.data() + at_ - length);
        if (text[length - 1] != '\0') return fail(), std::string_view();
        return {text, length - 1};
    }
    /// Count of a sequence whose elements take at least `element_bytes` each: a count that the rest of the
    /// message cannot hold is refused before anybody allocates for it.
    std::uint32_t get_count(std::size_t element_bytes) {
        const auto count = get<std::uint32_t>();
        if (!ok_ || count > remaining() / (element_bytes ? element_bytes : 1)) return fail(), 0;
        return count;
    }
    /// `bytes` bytes in a row from the next multiple of `alignment`; empty when they are not there.
    std::span<const std::byte> get_block(std::size_t bytes, std::size_t alignment) {
        if (!align(alignment) || !take(bytes)) return {};
        return in_.subspan(at_ - bytes, bytes);
    }
    bool align(std::size_t alignment) { return take((0 - at_) & (alignment - 1)); }

    bool ok() const { return ok_; }
    std::size_t position() const { return at_; }
    std::size_t remaining() const { return in_.size() - at_; }

  private:
    bool take(std::size_t bytes) {
        if (!ok_ || bytes > remaining()) return fail(), false;
        at_ += bytes;
        return true;
    }
    void fail() { ok_ = false; }

    std::span<const std::byte> in_;
    std::size_t at_ = 0;
    bool ok_ = true;
};

} // namespace tandem::wire
