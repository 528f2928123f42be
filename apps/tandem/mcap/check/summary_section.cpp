// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/check/summary_section.hpp"

namespace tandem::mcap {
namespace {

bool same_place(const AttachmentIndex& a, const AttachmentIndex& b) {
    return a.length == b.length && a.data_size == b.data_size &&
           a.attachment.log_time == b.attachment.log_time &&
           a.attachment.create_time == b.attachment.create_time && a.attachment.name == b.attachment.name &&
           a.attachment.media_type == b.attachment.media_type;
}

bool same_place(const MetadataIndex& a, const MetadataIndex& b) {
    return a.length == b.length && a.name == b.name;
}

} // namespace

void SummarySectionCheck::check(const RecordView& record) {
    auto& group = groups_.try_emplace(record.op, Group{record.offset, 0}).first->second;
    if (record.op != last_ && group.length > 0 && record.op < OpCode{0x80})
        findings_.error("{} is not next to the other records of its kind in the summary", name_of(record));
    group.length += record.size();
    last_ = record.op;
    switch (record.op) {
    case OpCode::schema:
    case OpCode::channel:
        return check_definition(record);
    case OpCode::chunk_index:
        return check_chunk_index(record);
    case OpCode::attachment_index:
        return check_index<AttachmentIndex>(record, facts_.attachments, attachments_);
    case OpCode::metadata_index:
        return check_index<MetadataIndex>(record, facts_.metadata, metadata_);
    case OpCode::statistics:
        return check_statistics(record);
    case OpCode::summary_offset:
        return check_offset(record);
    default:
        if (record.op <= OpCode::data_end)
            findings_.error("{} is not allowed in the summary", name_of(record));
    }
}

void SummarySectionCheck::check_definition(const RecordView& record) {
    // The data section is the reference: additional definitions in the summary are wrong.
    const auto id = FieldReader(record.content).number<std::uint16_t>();
    const bool schema = record.op == OpCode::schema;
    const bool known =
        schema ? facts_.definitions.schemas.contains(id) : facts_.definitions.channels.contains(id);
    if (!known) findings_.error("{} has the id {}, which is not in the data section", name_of(record), id);
    (schema ? schemas_ : channels_).insert(id);
    if (schema)
        check_schema(record, facts_.definitions, findings_);
    else
        check_channel(record, facts_.definitions, findings_);
}

void SummarySectionCheck::check_chunk_index(const RecordView& record) {
    const auto index = parsed<ChunkIndex>(record.content);
    const std::string name = name_of(record);
    if (!chunks_.insert(index.chunk_offset).second)
        findings_.error("{} is the second one of the chunk at byte {}", name, index.chunk_offset);
    const auto found = facts_.chunks.find(index.chunk_offset);
    if (found == facts_.chunks.end()) {
        findings_.error("{} points to byte {}, where there is no chunk", name, index.chunk_offset);
        return;
    }
    const auto& [length, head, channels] = found->second;
    findings_.expect_equal(index.chunk_length, length, name + ": chunk_length");
    findings_.expect_equal(index.start_time, head.start_time, name + ": message_start_time");
    findings_.expect_equal(index.end_time, head.end_time, name + ": message_end_time");
    findings_.expect_equal('"' + index.compression + '"', '"' + head.compression + '"',
                           name + ": compression");
    findings_.expect_equal(index.stored_size, head.stored_size, name + ": compressed_size");
    findings_.expect_equal(index.uncompressed_size, head.uncompressed_size, name + ": uncompressed_size");
}

template <typename Index>
void SummarySectionCheck::check_index(const RecordView& record, const std::map<std::uint64_t, Index>& known,
                                      std::size_t& count) {
    ++count;
    const auto index = parsed<Index>(record.content);
    const auto found = known.find(index.offset);
    if (found == known.end() || !same_place(found->second, index))
        findings_.error("{} does not match the record at byte {}", name_of(record), index.offset);
}

void SummarySectionCheck::check_statistics(const RecordView& record) {
    const auto statistics = parsed<Statistics>(record.content);
    const std::string name = name_of(record);
    if (groups_[OpCode::statistics].length > record.size()) findings_.error("{} is not the only one", name);
    std::uint64_t messages = 0;
    for (const auto& [channel, count] : facts_.messages) messages += count;
    findings_.expect_equal(statistics.message_count, messages, name + ": message_count");
    findings_.expect_equal(statistics.schema_count, facts_.definitions.schemas.size(),
                           name + ": schema_count");
    findings_.expect_equal(statistics.channel_count, facts_.definitions.channels.size(),
                           name + ": channel_count");
    findings_.expect_equal(statistics.attachment_count, facts_.attachments.size(),
                           name + ": attachment_count");
    findings_.expect_equal(statistics.metadata_count, facts_.metadata.size(), name + ": metadata_count");
    findings_.expect_equal(statistics.chunk_count, facts_.chunks.size(), name + ": chunk_count");
    findings_.expect_equal(statistics.start_time, facts_.times.start(), name + ": message_start_time");
    findings_.expect_equal(statistics.end_time, facts_.times.end(), name + ": message_end_time");
    if (statistics.channel_message_counts.empty()) return; // "is not available"
    const std::map<std::uint16_t, std::uint64_t> counts(statistics.channel_message_counts.begin(),
                                                        statistics.channel_message_counts.end());
    for (const auto& [channel, count] : facts_.messages)
        findings_.expect_equal(counts.contains(channel) ? counts.at(channel) : 0, count,
                               fmt::format("{}: message count of channel {}", name, channel));
}

void SummarySectionCheck::check_offset(const RecordView& record) {
    const auto offset = parsed<SummaryOffset>(record.content);
    const auto group = groups_.find(offset.group);
    if (group == groups_.end() || group->second.start != offset.start ||
        group->second.length != offset.length)
        findings_.error("{} does not describe the {} records of the summary", name_of(record),
                        record_name(offset.group));
}

void SummarySectionCheck::finish() {
    if (chunks_.empty())
        return; // without chunk indexes, readers read from the front and do not need these records
    if (facts_.messages_outside_chunks)
        findings_.warning("messages are outside chunks, where readers that use the indexes do not find them");
    for (const auto& [offset, chunk] : facts_.chunks) {
        if (!chunks_.contains(offset)) findings_.error("the Chunk at byte {} has no ChunkIndex", offset);
        for (const auto channel : chunk.channels) {
            const auto found = facts_.definitions.channels.find(channel);
            if (found == facts_.definitions.channels.end()) continue; // already reported with the message
            if (!channels_.contains(channel))
                findings_.error("channel {} of the Chunk at byte {} is not in the summary", channel, offset);
            const auto schema = found->second.schema_id;
            if (schema != 0 && !schemas_.contains(schema))
                findings_.error("schema {} of the Chunk at byte {} is not in the summary", schema, offset);
        }
    }
    if (attachments_ > 0 && attachments_ < facts_.attachments.size())
        findings_.error("{} attachments have no AttachmentIndex", facts_.attachments.size() - attachments_);
    if (metadata_ > 0 && metadata_ < facts_.metadata.size())
        findings_.error("{} metadata records have no MetadataIndex", facts_.metadata.size() - metadata_);
}

} // namespace tandem::mcap
