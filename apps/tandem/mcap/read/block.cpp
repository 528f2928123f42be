// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/read/block.hpp"

#include "apps/tandem/mcap/compression.hpp"
#include "apps/tandem/mcap/format/crc32.hpp"
#include "apps/tandem/mcap/format/decode.hpp"

#include <algorithm>

namespace tandem::mcap {
namespace {

constexpr std::uint64_t max_uncompressed = 1UL << 30U; // a few bytes of zstd can decompress to any size

} // namespace

void load(File& file, const Block& block, Bytes& records, ChunkHead* head) {
    records.clear();
    if (!block.chunk) {
        const ByteView bytes = file.read(block.offset, block.length);
        records.assign(bytes.begin(), bytes.end());
        return;
    }
    const auto place = file.record_at(block.offset);
    if (!place || place->op != OpCode::chunk || !(block.cut || file.holds(*place))) throw Error("is missing");
    const std::uint64_t available = std::min(place->length, file.size() - place->content());
    const auto chunk =
        parsed<ChunkHead>(file.read(place->content(), std::min<std::uint64_t>(available, chunk_head_limit)));
    if (head != nullptr) *head = chunk;
    const std::uint64_t before = chunk_head_size(chunk.compression.size());
    if (chunk.stored_size > place->length - before) throw Error("has records longer than the chunk");
    if (chunk.uncompressed_size > max_uncompressed) throw Error("has more than 1 GiB");
    if (block.cut) {
        const ByteView rest = file.read(place->content() + before, available - before);
        records.assign(rest.begin(), rest.end());
        return;
    }
    decompress(chunk.compression, file.read(place->content() + before, chunk.stored_size),
               chunk.uncompressed_size, records);
    if (chunk.uncompressed_crc != 0 && crc32(records) != chunk.uncompressed_crc)
        throw Error("does not match its CRC-32");
}

} // namespace tandem::mcap
