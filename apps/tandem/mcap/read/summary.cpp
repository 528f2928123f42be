// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/read/summary.hpp"

#include "apps/tandem/mcap/format/crc32.hpp"
#include "apps/tandem/mcap/format/decode.hpp"

#include <algorithm>
#include <cstring>

namespace tandem::mcap {
namespace {

constexpr std::uint64_t footer_size = record_head_size + 8 + 8 + 4; // "Records": it will not be extended

void add_chunk(Contents& contents, const ChunkIndex& index, std::uint64_t data_end) {
    if (index.chunk_offset > data_end || index.chunk_length > data_end - index.chunk_offset)
        throw Error("a chunk index points beyond the data");
    contents.blocks.push_back({index.chunk_offset, index.chunk_length, true, false, index.start_time,
                               index.end_time, index.uncompressed_size, index.compression});
    for (const auto& [channel, offset] : index.message_index_offsets) {
        const auto at = contents.blocks.size() - 1; // assumes chunk indexes in file order
        contents.blocks_of_channel.try_emplace(channel, at, at).first->second.second = at;
    }
}

void add_record(Contents& contents, const RecordView& record, std::uint64_t data_end) {
    switch (record.op) {
    case OpCode::schema: {
        auto schema = parsed<Schema>(record.content);
        contents.schemas.emplace(schema.id, std::move(schema));
        break;
    }
    case OpCode::channel: {
        auto channel = parsed<Channel>(record.content);
        contents.channels.emplace(channel.id, std::move(channel));
        break;
    }
    case OpCode::chunk_index:
        add_chunk(contents, parsed<ChunkIndex>(record.content), data_end);
        break;
    case OpCode::attachment_index:
        contents.attachments.push_back(parsed<AttachmentIndex>(record.content));
        break;
    case OpCode::metadata_index:
        contents.metadata.push_back(parsed<MetadataIndex>(record.content));
        break;
    case OpCode::statistics:
        contents.statistics = parsed<Statistics>(record.content);
        break;
    default:
        break; // unknown records, and unused summary offsets
    }
}

/// Returns whether the summary lists everything that its statistics count.
bool lists_everything(const Contents& contents, bool has_statistics) {
    const Statistics& counts = contents.statistics;
    const bool ordered = std::ranges::is_sorted(contents.blocks, {}, &Block::offset);
    return has_statistics && ordered && contents.blocks.size() == counts.chunk_count &&
           (counts.chunk_count > 0 || counts.message_count == 0) &&
           contents.schemas.size() == counts.schema_count &&
           contents.channels.size() == counts.channel_count &&
           contents.attachments.size() == counts.attachment_count &&
           contents.metadata.size() == counts.metadata_count;
}

} // namespace

std::optional<FooterPlace> find_footer(File& file) {
    constexpr std::uint64_t tail = footer_size + sizeof(magic);
    if (file.size() < tail + sizeof(magic)) return {};
    const std::uint64_t offset = file.size() - tail;
    const ByteView bytes = file.read(offset, tail);
    if (std::memcmp(bytes.data() + footer_size, magic, sizeof(magic)) != 0) return {};
    const auto record = RecordSequence(bytes.first(footer_size)).next();
    if (!record || record->op != OpCode::footer || record->size() != footer_size) return {};
    return FooterPlace{offset, parsed<Footer>(record->content)};
}

SummaryState read_summary(File& file, Contents& contents, std::string& fault) {
    const auto end = find_footer(file);
    if (!end) return SummaryState::no_end;
    const Footer& footer = end->footer;
    if (footer.summary_start == 0) return SummaryState::absent;
    try {
        if (footer.summary_start > end->offset) throw Error("it begins after the footer");
        // The CRC also covers the footer's fields before it.
        const ByteView bytes =
            file.read(footer.summary_start, end->offset + footer_size - 4 - footer.summary_start);
        if (footer.summary_crc != 0 && crc32(bytes) != footer.summary_crc)
            throw Error("it does not match the CRC-32 in the footer");
        RecordSequence records(bytes.first(end->offset - footer.summary_start));
        bool has_statistics = false;
        while (const auto record = records.next()) {
            add_record(contents, *record, footer.summary_start);
            has_statistics = has_statistics || record->op == OpCode::statistics;
        }
        if (records.torn()) throw Error("its last record is longer than the summary");
        return lists_everything(contents, has_statistics) ? SummaryState::sound : SummaryState::absent;
    } catch (const Error& error) {
        fault = error.what();
        return SummaryState::damaged;
    }
}

} // namespace tandem::mcap
