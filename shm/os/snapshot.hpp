// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/shared_copy.hpp"

#include <cstddef>
#include <span>

namespace tandem::shm {

/// A private copy of a struct that another process may be changing at the same moment, and the only way to its bytes: each
/// word is read once, so a value that was checked is the value that is used. The structs of layout.hpp hold atomics, so
/// fields are read one by one: snapshot.get<std::uint64_t>(offsetof(RingHeader, sent)).
template <class T, std::size_t Bytes = sizeof(T)>
class Snapshot {
  public:
    Snapshot() = default; ///< all bytes are 0
    /// Copies the struct out of mapped memory, which is 8-aligned.
    explicit Snapshot(const void* shared) { copy_from_shared(bytes_, shared, Bytes); }

    /// Returns a field; 0 if it is not within the copy.
    template <class Field>
    Field get(std::size_t offset) const {
        Field value{};
        if (offset <= Bytes && sizeof value <= Bytes - offset)
            std::memcpy(&value, bytes_ + offset, sizeof value);
        return value;
    }
    std::uint64_t word(std::size_t offset) const { return get<std::uint64_t>(offset); }
    std::uint32_t half(std::size_t offset) const { return get<std::uint32_t>(offset); }

    /// Returns the place of the bytes [from, to), for ReadOnlySnapshot to copy them from a file.
    std::span<std::byte> room(std::size_t from = 0, std::size_t to = Bytes) {
        return std::span(bytes_).subspan(from, to - from);
    }
    std::span<const std::byte> bytes() const { return bytes_; }

  private:
    alignas(8) std::byte bytes_[Bytes] = {};
};

} // namespace tandem::shm
