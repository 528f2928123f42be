// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/read/file.hpp"

namespace tandem::mcap {

/// A part of a file that is read at once: a chunk, or messages that stand one behind the other without a chunk.
struct Block {
    std::uint64_t offset = 0, length = 0; ///< of the records, op codes included
    bool chunk = true;
    bool cut = false;                           ///< the file ends within this chunk, which is not compressed
    std::uint64_t start_time = 0, end_time = 0; ///< log times of its messages
    std::uint64_t uncompressed_size = 0;        ///< without the head of a chunk
    std::string compression;
};

/// Replaces `records` by the block's records, uncompressed; `head`, if given, by the chunk's. Throws Error, without the
/// file's name, for a chunk that is damaged, has more than 1 GiB, or a compression that is not known; with the name, if
/// the file cannot be read.
void load(File& file, const Block& block, Bytes& records, ChunkHead* head = nullptr);

} // namespace tandem::mcap
