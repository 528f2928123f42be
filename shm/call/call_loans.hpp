// SPDX-License-Identifier: Apache-2.0
// Internal to the call queue: arguments and results that are too long for a slot and its overflow buffer.
#pragma once
#include <cstddef>
#include <cstdint>

namespace tandem::shm {

/// Long payloads in the segment's file, after the mapped memory (layout.hpp). Each slot has one, which belongs to the call in
/// the slot.
struct CallLoans {
    int file = -1;
    std::uint64_t begin = 0, stride = 0; ///< offset in the file of the first slot's loan; from slot to slot

    /// Copies a payload to the slot's loan, which gets memory for it. Returns false, without a loan, if there is none.
    bool write(std::uint32_t slot, const void* from, std::size_t bytes) const;
    /// Returns whether the slot's loan has memory for this number of bytes. The peer may claim more than it has written.
    bool has(std::uint32_t slot, std::size_t bytes) const;
    /// Copies a payload out of the slot's loan. Returns false if the file is too short.
    bool read(std::uint32_t slot, void* to, std::size_t bytes) const;
    /// Gives the memory of the slot's loan back.
    void give_back(std::uint32_t slot) const;

  private:
    std::uint64_t offset_of(std::uint32_t slot) const { return begin + slot * stride; }
};

} // namespace tandem::shm
