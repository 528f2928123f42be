// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace tandem::link {

/// A port table in the segment. Its owner replaces it when its ports change:
///
///     version | bytes of the table | table | unused | version
///
/// Words of 8 bytes. The owner stores the last word first and the first word last, and a reader copies from the
/// front. Therefore a copy with two equal versions contains one complete table.
struct PublishedTable {
    std::uint64_t version = 0; ///< 1 for the first table of a session, plus 1 with each change
    PortTable table{};
};

/// Returns the size of a blob for an encoded table of this size. `may_change`: adds room for ports that are added
/// later.
std::size_t published_table_bytes(std::size_t encoded_bytes, bool may_change);

/// Writes an encoded table into the blob. Returns false, and keeps the last table, if it does not fit.
bool write_published_table(std::span<std::byte> blob, std::span<const std::byte> encoded,
                           std::uint64_t version);

/// Returns the current version in the blob, which another process may be changing.
std::uint64_t published_version(std::span<const std::byte> blob);

/// Reads a copy of the blob. Returns nothing if the owner changed the table during the copy. Throws LinkError if the
/// bytes are not a table.
std::optional<PublishedTable> read_published_table(std::span<const std::byte> copy);

} // namespace tandem::link
