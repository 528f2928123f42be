// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/read/file.hpp"

namespace tandem::mcap {

/// A part of a file that is read at once: a chunk, or adjacent messages outside of chunks.
struct Block {
    std::uint64_t offset = 0, length = 0; ///< of the records, including op codes
    bool chunk = true;
    bool cut = false;                           ///< the file ends within this uncompressed chunk
    std::uint64_t start_time = 0, end_time = 0; ///< range of the messages' log times
    std::uint64_t uncompressed_size = 0;        ///< without the head of a chunk
    std::string compression;
};

/// Replaces `records` by the block's uncompressed records, and `*head`, unless null, by the chunk's head. Throws Error:
/// without the file's name if the chunk is damaged, larger than 1 GiB, or its compression is unknown; with the name if
/// the file cannot be read.
void load(File& file, const Block& block, Bytes& records, ChunkHead* head = nullptr);

} // namespace tandem::mcap
