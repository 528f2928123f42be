// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/segment/mapping.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace tandem::shm {

/// One object of a side: kind, name and memory, checked to be inside that side's arena.
struct ObjectInfo {
    std::string name;
    layout::ObjectKind kind;
    std::span<std::byte> memory;
};

/// [one thread] The directories of both sides: adds to this side's directory and reads both.
class Directory {
  public:
    explicit Directory(std::shared_ptr<const Mapping> mapping);

    /// Allocates memory for a new object in this side's arena, 128-aligned, and lists it. In a sparse segment, reserves its
    /// first `reserved_bytes` bytes. Throws Error if it does not fit.
    std::span<std::byte> add(const std::string& name, layout::ObjectKind kind, std::uint64_t bytes,
                             std::uint64_t reserved_bytes);
    /// Makes all objects added so far visible to the peer.
    void publish();

    std::vector<ObjectInfo> list(Side owner) const; ///< Throws Error if an entry is damaged.
    /// Returns an object; empty if that side has published no such object. Throws Error if an entry is damaged.
    std::optional<std::span<std::byte>> find(Side owner, const std::string& name,
                                             layout::ObjectKind kind) const;

  private:
    std::uint32_t count(Side owner) const;
    ObjectInfo entry(Side owner, std::uint32_t index) const;

    std::shared_ptr<const Mapping> mapping_;
    std::uint32_t added_ = 0; // private copies: the shared words are only for the peer
    std::uint64_t used_ = 0;
};

} // namespace tandem::shm
