// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/segment/mapping.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace tandem::shm {

/// One object of a half: kind, name and place, checked to lie inside that half's arena.
struct ObjectInfo {
    std::string name;
    layout::ObjectKind kind;
    std::span<std::byte> memory;
};

/// The tables of contents of both halves: adds to mine, reads both.
class Directory {
  public:
    explicit Directory(std::shared_ptr<const Mapping> mapping);

    /// Takes memory for a new object from my arena, 128-aligned, and lists it. In a sparse segment its first
    /// `at_once` bytes are reserved. Throws Error if it does not fit.
    std::span<std::byte> add(const std::string& name, layout::ObjectKind kind, std::uint64_t bytes,
                             std::uint64_t at_once);
    void publish();

    std::vector<ObjectInfo> list(Side half) const; ///< Throws Error if an entry is not sound.
    std::optional<std::span<std::byte>> find(Side half, const std::string& name,
                                             layout::ObjectKind kind) const;

  private:
    std::uint32_t count(Side half) const;
    ObjectInfo entry(Side half, std::uint32_t index) const;

    std::shared_ptr<const Mapping> mapping_;
    std::uint32_t added_ = 0; // the shared words of my half are for the peer to read: I go by these
    std::uint64_t used_ = 0;
};

} // namespace tandem::shm
