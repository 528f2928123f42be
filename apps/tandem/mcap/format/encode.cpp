// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/format/encode.hpp"

#include "apps/tandem/mcap/format/crc32.hpp"
#include "apps/tandem/mcap/format/utf8.hpp"

#include <algorithm>
#include <limits>

namespace tandem::mcap {
namespace {

template <typename Number>
void put(Bytes& out, Number value) {
    const auto bytes = little_endian(value);
    out.insert(out.end(), bytes.begin(), bytes.end());
}

/// Appends the length of a string, an array or a map.
void put_length(Bytes& out, std::size_t length) {
    if (length > std::numeric_limits<std::uint32_t>::max())
        throw Error("MCAP: a field of " + std::to_string(length) + " bytes: at most 4294967295 fit");
    put(out, static_cast<std::uint32_t>(length));
}

void put_string(Bytes& out, const std::string& text) {
    if (!is_utf8(text)) throw Error("MCAP: the text \"" + text + "\" is not UTF-8");
    put_length(out, text.size());
    const auto bytes = std::as_bytes(std::span(text));
    out.insert(out.end(), bytes.begin(), bytes.end());
}

void patch(Bytes& out, std::size_t at, ByteView bytes) {
    std::copy(bytes.begin(), bytes.end(), out.begin() + static_cast<std::ptrdiff_t>(at));
}

/// Begins a record. Pass the result to end_record().
std::size_t begin_record(Bytes& out, OpCode op) {
    out.push_back(static_cast<std::byte>(op));
    put(out, std::uint64_t{0});
    return out.size();
}

/// Sets the length of a record. `behind`: number of bytes that the caller appends.
void end_record(Bytes& out, std::size_t begin, std::uint64_t behind = 0) {
    patch(out, begin - 8, little_endian(out.size() - begin + behind));
}

/// Sets the length in bytes of an array or a map. Its u32 is at `begin`.
void end_array(Bytes& out, std::size_t begin) {
    const std::size_t length = out.size() - begin - 4;
    if (length > std::numeric_limits<std::uint32_t>::max())
        throw Error("MCAP: an array of " + std::to_string(length) + " bytes: at most 4294967295 fit");
    patch(out, begin, little_endian(static_cast<std::uint32_t>(length)));
}

template <typename First, typename Second>
void put_pairs(Bytes& out, const std::vector<std::pair<First, Second>>& pairs) {
    put_length(out, pairs.size() * (sizeof(First) + sizeof(Second)));
    for (const auto& [first, second] : pairs) {
        put(out, first);
        put(out, second);
    }
}

void put_map(Bytes& out, const StringMap& map) {
    const std::size_t begin = out.size();
    put(out, std::uint32_t{0});
    for (const auto& [key, value] : map) {
        put_string(out, key);
        put_string(out, value);
    }
    end_array(out, begin);
}

} // namespace

void append(Bytes& out, const Header& header) {
    const auto begin = begin_record(out, OpCode::header);
    put_string(out, header.profile);
    put_string(out, header.library);
    end_record(out, begin);
}

void append(Bytes& out, Footer footer) {
    const std::size_t at = out.size();
    const auto begin = begin_record(out, OpCode::footer);
    put(out, footer.summary_start);
    put(out, footer.summary_offset_start);
    end_record(out, begin, 4);
    put(out, crc32(ByteView(out).subspan(at), footer.summary_crc));
}

void append(Bytes& out, const Schema& schema) {
    const auto begin = begin_record(out, OpCode::schema);
    put(out, schema.id);
    put_string(out, schema.name);
    put_string(out, schema.encoding);
    put_length(out, schema.data.size());
    out.insert(out.end(), schema.data.begin(), schema.data.end());
    end_record(out, begin);
}

void append(Bytes& out, const Channel& channel) {
    const auto begin = begin_record(out, OpCode::channel);
    put(out, channel.id);
    put(out, channel.schema_id);
    put_string(out, channel.topic);
    put_string(out, channel.message_encoding);
    put_map(out, channel.metadata);
    end_record(out, begin);
}

void append(Bytes& out, const Message& message) {
    std::array<std::byte, record_head_size + message_head_size>
        head; // one insertion, because this happens 200,000 times a second
    head[0] = static_cast<std::byte>(OpCode::message);
    const auto store = [&](std::size_t at, auto value) {
        std::ranges::copy(little_endian(value), head.begin() + at);
    };
    store(1, std::uint64_t{message_head_size + message.data.size()});
    store(9, message.channel_id);
    store(11, message.sequence);
    store(15, message.log_time);
    store(23, message.publish_time);
    out.insert(out.end(), head.begin(), head.end());
    out.insert(out.end(), message.data.begin(), message.data.end());
}

void append_head(Bytes& out, const ChunkHead& chunk) {
    const auto begin = begin_record(out, OpCode::chunk);
    put(out, chunk.start_time);
    put(out, chunk.end_time);
    put(out, chunk.uncompressed_size);
    put(out, chunk.uncompressed_crc);
    put_string(out, chunk.compression);
    put(out, chunk.stored_size);
    end_record(out, begin, chunk.stored_size);
}

void append(Bytes& out, const MessageIndex& index) {
    const auto begin = begin_record(out, OpCode::message_index);
    put(out, index.channel_id);
    put_pairs(out, index.entries);
    end_record(out, begin);
}

void append(Bytes& out, const ChunkIndex& index) {
    const auto begin = begin_record(out, OpCode::chunk_index);
    put(out, index.start_time);
    put(out, index.end_time);
    put(out, index.chunk_offset);
    put(out, index.chunk_length);
    put_pairs(out, index.message_index_offsets);
    put(out, index.message_index_length);
    put_string(out, index.compression);
    put(out, index.stored_size);
    put(out, index.uncompressed_size);
    end_record(out, begin);
}

void append_head(Bytes& out, const AttachmentHead& attachment, std::uint64_t data_size) {
    const auto begin = begin_record(out, OpCode::attachment);
    put(out, attachment.log_time);
    put(out, attachment.create_time);
    put_string(out, attachment.name);
    put_string(out, attachment.media_type);
    put(out, data_size);
    end_record(out, begin, data_size + 4);
}

void append(Bytes& out, const AttachmentIndex& index) {
    const auto begin = begin_record(out, OpCode::attachment_index);
    put(out, index.offset);
    put(out, index.length);
    put(out, index.attachment.log_time);
    put(out, index.attachment.create_time);
    put(out, index.data_size);
    put_string(out, index.attachment.name);
    put_string(out, index.attachment.media_type);
    end_record(out, begin);
}

void append(Bytes& out, const Metadata& metadata) {
    const auto begin = begin_record(out, OpCode::metadata);
    put_string(out, metadata.name);
    put_map(out, metadata.metadata);
    end_record(out, begin);
}

void append(Bytes& out, const MetadataIndex& index) {
    const auto begin = begin_record(out, OpCode::metadata_index);
    put(out, index.offset);
    put(out, index.length);
    put_string(out, index.name);
    end_record(out, begin);
}

void append(Bytes& out, const Statistics& statistics) {
    const auto begin = begin_record(out, OpCode::statistics);
    put(out, statistics.message_count);
    put(out, statistics.schema_count);
    put(out, statistics.channel_count);
    put(out, statistics.attachment_count);
    put(out, statistics.metadata_count);
    put(out, statistics.chunk_count);
    put(out, statistics.start_time);
    put(out, statistics.end_time);
    put_pairs(out, statistics.channel_message_counts);
    end_record(out, begin);
}

void append(Bytes& out, const SummaryOffset& offset) {
    const auto begin = begin_record(out, OpCode::summary_offset);
    out.push_back(static_cast<std::byte>(offset.group));
    put(out, offset.start);
    put(out, offset.length);
    end_record(out, begin);
}

void append(Bytes& out, const DataEnd& end) {
    const auto begin = begin_record(out, OpCode::data_end);
    put(out, end.data_section_crc);
    end_record(out, begin);
}

} // namespace tandem::mcap
