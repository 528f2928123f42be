// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/check/data_section.hpp"

#include "apps/tandem/mcap/contents.hpp"
#include "apps/tandem/mcap/format/crc32.hpp"
#include "apps/tandem/mcap/format/utf8.hpp"

#include <algorithm>

namespace tandem::mcap {
namespace {

void check_text(const RecordView& record, const char* field, const std::string& text, Findings& findings) {
    if (!is_utf8(text)) findings.error("{} has a {} that is not UTF-8", name_of(record), field);
}

template <typename Definition>
void add(const RecordView& record, Definition definition, std::map<std::uint16_t, Definition>& known,
         Findings& findings) {
    const auto [before, is_new] = known.try_emplace(definition.id, definition);
    if (!is_new && !(before->second == definition))
        findings.error("{} differs from an earlier one with the id {}", name_of(record), definition.id);
}

} // namespace

void check_schema(const RecordView& record, Definitions& known, Findings& findings) {
    auto schema = parsed<Schema>(record.content);
    if (schema.id == 0) findings.error("{} has the id 0, which is reserved", name_of(record));
    if (schema.encoding.empty() && !schema.data.empty())
        findings.error("{} (id {}) has data, but no encoding", name_of(record), schema.id);
    if (schema.encoding.empty() && schema.data.empty())
        findings.warning("{} (id {}) has neither encoding nor data", name_of(record), schema.id);
    check_text(record, "name", schema.name, findings);
    check_text(record, "encoding", schema.encoding, findings);
    add(record, std::move(schema), known.schemas, findings);
}

void check_channel(const RecordView& record, Definitions& known, Findings& findings) {
    auto channel = parsed<Channel>(record.content);
    if (channel.schema_id != 0 && !known.schemas.contains(channel.schema_id))
        findings.error("{} (id {}) has the schema {}, which the file does not define before it",
                       name_of(record), channel.id, channel.schema_id);
    check_text(record, "topic", channel.topic, findings);
    check_text(record, "message encoding", channel.message_encoding, findings);
    for (const auto& [key, value] : channel.metadata) {
        check_text(record, "metadata key", key, findings);
        check_text(record, "metadata value", value, findings);
    }
    add(record, std::move(channel), known.channels, findings);
}

void DataSectionCheck::check(const RecordPlace& place) {
    if (place.op != OpCode::message_index) end_indexes();
    const auto record = [&] { return RecordView{place.op, file_.content_of(place), place.offset}; };
    switch (place.op) {
    case OpCode::schema:
        return check_schema(record(), facts_.definitions, findings_);
    case OpCode::channel:
        return check_channel(record(), facts_.definitions, findings_);
    case OpCode::message:
        facts_.messages_outside_chunks = true;
        return check_message(record(), nullptr);
    case OpCode::chunk:
        return check_chunk(place);
    case OpCode::message_index:
        return check_message_index(record());
    case OpCode::attachment:
        return check_attachment(place);
    case OpCode::metadata:
        facts_.metadata[place.offset] = {place.offset, record_head_size + place.length,
                                         parsed<Metadata>(record().content).name};
        return;
    case OpCode::header:
    case OpCode::chunk_index:
    case OpCode::attachment_index:
    case OpCode::statistics:
    case OpCode::metadata_index:
    case OpCode::summary_offset:
        findings_.error("the {} at byte {} is not allowed in the data section", record_name(place.op),
                        place.offset);
        return;
    default:
        return; // readers skip other records
    }
}

DataFacts DataSectionCheck::finish() {
    end_indexes();
    if (out_of_order_ > 0)
        findings_.warning("{} messages have a log time before that of an earlier message", out_of_order_);
    return std::move(facts_);
}

void DataSectionCheck::check_message(const RecordView& record, Entries* index) {
    const auto message = parsed<Message>(record.content);
    if (!facts_.definitions.channels.contains(message.channel_id))
        findings_.error("{} belongs to channel {}, which the file does not define before it", name_of(record),
                        message.channel_id);
    if (!facts_.messages.empty() && message.log_time < facts_.times.end()) ++out_of_order_;
    ++facts_.messages[message.channel_id];
    facts_.times.add(message.log_time);
    if (index != nullptr) index->emplace_back(message.log_time, record.offset);
}

void DataSectionCheck::check_chunk(const RecordPlace& place) {
    auto& facts = facts_.chunks[place.offset];
    facts.length = record_head_size + place.length;
    load(file_, Block{place.offset, facts.length, true, false, 0, 0, 0, ""}, records_, &facts.head);
    chunk_offset_ = place.offset;
    TimeRange times;
    RecordSequence sequence(records_);
    while (const auto record = sequence.next()) {
        try {
            if (record->op == OpCode::schema)
                check_schema(*record, facts_.definitions, findings_);
            else if (record->op == OpCode::channel)
                check_channel(*record, facts_.definitions, findings_);
            else if (record->op == OpCode::message) {
                const auto message = parsed<Message>(record->content);
                times.add(message.log_time);
                facts.channels.insert(message.channel_id);
                check_message(*record, &last_chunk_[message.channel_id]);
            } else if (record->op <= OpCode::data_end)
                findings_.error("{} of the Chunk at byte {} is not allowed in a chunk", name_of(*record),
                                place.offset);
        } catch (const Error& error) {
            findings_.error("{} of the Chunk at byte {} {}", name_of(*record), place.offset, error.what());
        }
    }
    const std::string chunk = fmt::format("the Chunk at byte {}", place.offset);
    if (sequence.torn()) findings_.error("{} ends in the middle of a record", chunk);
    findings_.expect_equal(facts.head.start_time, times.start(), chunk + ": message_start_time");
    findings_.expect_equal(facts.head.end_time, times.end(), chunk + ": message_end_time");
    const auto size = chunk_head_size(facts.head.compression.size()) + facts.head.stored_size;
    findings_.expect_equal(place.length, size, chunk + ": its length");
}

void DataSectionCheck::check_message_index(const RecordView& record) {
    auto index = parsed<MessageIndex>(record.content);
    if (chunk_offset_ == 0) {
        findings_.error("{} does not follow a chunk", name_of(record));
        return;
    }
    if (!indexed_.insert(index.channel_id).second)
        findings_.error("{} is the second one of channel {} after its chunk", name_of(record),
                        index.channel_id);
    auto& expected = last_chunk_[index.channel_id];
    std::ranges::sort(expected);
    std::ranges::sort(index.entries);
    if (index.entries != expected)
        findings_.error("{} does not list the messages of channel {} in the Chunk at byte {}",
                        name_of(record), index.channel_id, chunk_offset_);
}

void DataSectionCheck::end_indexes() {
    for (const auto& [channel, entries] : last_chunk_)
        if (!entries.empty() && !indexed_.contains(channel))
            findings_.warning("the Chunk at byte {} has no MessageIndex for channel {}", chunk_offset_,
                              channel);
    last_chunk_.clear();
    indexed_.clear();
    chunk_offset_ = 0;
}

void DataSectionCheck::check_attachment(const RecordPlace& place) {
    const auto attachment = attachment_at(file_, place);
    facts_.attachments[place.offset] = {place.offset, record_head_size + place.length, attachment.head,
                                        attachment.data_size};
    const std::uint64_t end = attachment.data_offset + attachment.data_size;
    std::uint32_t crc = 0;
    constexpr std::uint64_t step = 1 << 20;
    for (std::uint64_t at = place.content(); at < end; at += step)
        crc = crc32(file_.read(at, std::min(step, end - at)), crc);
    const auto named = FieldReader(file_.read(end, 4)).number<std::uint32_t>();
    if (named != 0)
        findings_.expect_equal(named, crc, fmt::format("the Attachment at byte {}: crc", place.offset));
}

} // namespace tandem::mcap
