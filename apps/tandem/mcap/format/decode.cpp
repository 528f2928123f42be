// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/format/decode.hpp"

#include <array>

namespace tandem::mcap {
namespace {

template <typename First, typename Second>
std::vector<std::pair<First, Second>> pairs(FieldReader& from) {
    const ByteView entries = from.take(from.number<std::uint32_t>());
    constexpr std::size_t size = sizeof(First) + sizeof(Second);
    if (entries.size() % size != 0) throw Error("has an array that ends within an entry");
    std::vector<std::pair<First, Second>> result;
    result.reserve(entries.size() / size);
    FieldReader fields(entries);
    while (!fields.rest().empty()) {
        const auto first = fields.number<First>();
        result.emplace_back(first, fields.number<Second>());
    }
    return result;
}

} // namespace

ByteView FieldReader::take(std::uint64_t size) {
    if (size > rest_.size()) throw Error("is shorter than its fields");
    const ByteView taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
}

std::string FieldReader::text() {
    const ByteView bytes = take(number<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

StringMap FieldReader::map() {
    FieldReader entries(take(number<std::uint32_t>()));
    StringMap result;
    while (!entries.rest().empty()) {
        auto key = entries.text();
        result[std::move(key)] = entries.text();
    }
    return result;
}

void parse(ByteView content, Header& header) {
    FieldReader from(content);
    header.profile = from.text();
    header.library = from.text();
}

void parse(ByteView content, Footer& footer) {
    FieldReader from(content);
    footer.summary_start = from.number<std::uint64_t>();
    footer.summary_offset_start = from.number<std::uint64_t>();
    footer.summary_crc = from.number<std::uint32_t>();
}

void parse(ByteView content, Schema& schema) {
    FieldReader from(content);
    schema.id = from.number<std::uint16_t>();
    schema.name = from.text();
    schema.encoding = from.text();
    const ByteView data = from.take(from.number<std::uint32_t>());
    schema.data.assign(data.begin(), data.end());
}

void parse(ByteView content, Channel& channel) {
    FieldReader from(content);
    channel.id = from.number<std::uint16_t>();
    channel.schema_id = from.number<std::uint16_t>();
    channel.topic = from.text();
    channel.message_encoding = from.text();
    channel.metadata = from.map();
}

void parse(ByteView content, Message& message) {
    FieldReader from(content);
    message.channel_id = from.number<std::uint16_t>();
    message.sequence = from.number<std::uint32_t>();
    message.log_time = from.number<std::uint64_t>();
    message.publish_time = from.number<std::uint64_t>();
    message.data = from.rest();
}

void parse(ByteView content, ChunkHead& chunk) {
    FieldReader from(content);
    chunk.start_time = from.number<std::uint64_t>();
    chunk.end_time = from.number<std::uint64_t>();
    chunk.uncompressed_size = from.number<std::uint64_t>();
    chunk.uncompressed_crc = from.number<std::uint32_t>();
    chunk.compression = from.text();
    chunk.stored_size = from.number<std::uint64_t>();
}

void parse(ByteView content, MessageIndex& index) {
    FieldReader from(content);
    index.channel_id = from.number<std::uint16_t>();
    index.entries = pairs<std::uint64_t, std::uint64_t>(from);
}

void parse(ByteView content, ChunkIndex& index) {
    FieldReader from(content);
    index.start_time = from.number<std::uint64_t>();
    index.end_time = from.number<std::uint64_t>();
    index.chunk_offset = from.number<std::uint64_t>();
    index.chunk_length = from.number<std::uint64_t>();
    index.message_index_offsets = pairs<std::uint16_t, std::uint64_t>(from);
    index.message_index_length = from.number<std::uint64_t>();
    index.compression = from.text();
    index.stored_size = from.number<std::uint64_t>();
    index.uncompressed_size = from.number<std::uint64_t>();
}

void parse(ByteView content, AttachmentIndex& index) {
    FieldReader from(content);
    index.offset = from.number<std::uint64_t>();
    index.length = from.number<std::uint64_t>();
    index.attachment.log_time = from.number<std::uint64_t>();
    index.attachment.create_time = from.number<std::uint64_t>();
    index.data_size = from.number<std::uint64_t>();
    index.attachment.name = from.text();
    index.attachment.media_type = from.text();
}

void parse(ByteView content, Metadata& metadata) {
    FieldReader from(content);
    metadata.name = from.text();
    metadata.metadata = from.map();
}

void parse(ByteView content, MetadataIndex& index) {
    FieldReader from(content);
    index.offset = from.number<std::uint64_t>();
    index.length = from.number<std::uint64_t>();
    index.name = from.text();
}

void parse(ByteView content, Statistics& statistics) {
    FieldReader from(content);
    statistics.message_count = from.number<std::uint64_t>();
    statistics.schema_count = from.number<std::uint16_t>();
    statistics.channel_count = from.number<std::uint32_t>();
    statistics.attachment_count = from.number<std::uint32_t>();
    statistics.metadata_count = from.number<std::uint32_t>();
    statistics.chunk_count = from.number<std::uint32_t>();
    statistics.start_time = from.number<std::uint64_t>();
    statistics.end_time = from.number<std::uint64_t>();
    statistics.channel_message_counts = pairs<std::uint16_t, std::uint64_t>(from);
}

void parse(ByteView content, SummaryOffset& offset) {
    FieldReader from(content);
    offset.group = OpCode{from.number<std::uint8_t>()};
    offset.start = from.number<std::uint64_t>();
    offset.length = from.number<std::uint64_t>();
}

void parse(ByteView content, DataEnd& end) {
    end.data_section_crc = FieldReader(content).number<std::uint32_t>();
}

std::string record_name(OpCode op) {
    constexpr std::array names{"",           "Header",        "Footer",          "Schema",
                               "Channel",    "Message",       "Chunk",           "MessageIndex",
                               "ChunkIndex", "Attachment",    "AttachmentIndex", "Statistics",
                               "Metadata",   "MetadataIndex", "SummaryOffset",   "DataEnd"};
    const auto code = static_cast<std::size_t>(op);
    if (code > 0 && code < names.size()) return names[code];
    constexpr const char* digits = "0123456789ABCDEF";
    return std::string("record 0x") + digits[code / 16] + digits[code % 16];
}

std::optional<RecordView> RecordSequence::next() {
    const ByteView rest = records_.subspan(position_);
    if (rest.size() < record_head_size) return {};
    const auto length = FieldReader(rest.subspan(1)).number<std::uint64_t>();
    if (length > rest.size() - record_head_size) return {};
    const RecordView record{OpCode{std::to_integer<std::uint8_t>(rest[0])},
                            rest.subspan(record_head_size, length), position_};
    position_ += record.size();
    return record;
}

} // namespace tandem::mcap
