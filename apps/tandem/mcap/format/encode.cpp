// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/format/encode.hpp"

#include "apps/tandem/mcap/format/crc32.hpp"
#include "apps/tandem/mcap/format/fields.hpp"
#include "apps/tandem/mcap/format/utf8.hpp"

#include <algorithm>
#include <limits>

namespace tandem::mcap {
namespace {

template <std::integral Number>
void put(Bytes& out, Number value) {
    const auto bytes = little_endian(value);
    out.insert(out.end(), bytes.begin(), bytes.end());
}

void put(Bytes& out, OpCode op) { out.push_back(static_cast<std::byte>(op)); }

/// Appends the length of a string, an array or a map.
void put_length(Bytes& out, std::size_t length) {
    if (length > std::numeric_limits<std::uint32_t>::max())
        throw Error("MCAP: a field of " + std::to_string(length) + " bytes: at most 4294967295 fit");
    put(out, static_cast<std::uint32_t>(length));
}

void put(Bytes& out, const Bytes& data) {
    put_length(out, data.size());
    out.insert(out.end(), data.begin(), data.end());
}

void put(Bytes& out, const std::string& text) {
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
    put(out, op);
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
void put(Bytes& out, const std::vector<std::pair<First, Second>>& pairs) {
    put_length(out, pairs.size() * (sizeof(First) + sizeof(Second)));
    for (const auto& [first, second] : pairs) {
        put(out, first);
        put(out, second);
    }
}

void put(Bytes& out, const StringMap& map) {
    const std::size_t begin = out.size();
    put(out, std::uint32_t{0});
    for (const auto& [key, value] : map) {
        put(out, key);
        put(out, value);
    }
    end_array(out, begin);
}

template <typename Record>
void put_fields(Bytes& out, const Record& record) {
    std::apply([&](const auto&... field) { (put(out, field), ...); }, fields_of(record));
}

/// Appends a record. `behind` as in end_record().
template <typename Record>
void put_record(Bytes& out, OpCode op, const Record& record, std::uint64_t behind = 0) {
    const auto begin = begin_record(out, op);
    put_fields(out, record);
    end_record(out, begin, behind);
}

} // namespace

void append(Bytes& out, const Header& header) { put_record(out, OpCode::header, header); }
void append(Bytes& out, const Schema& schema) { put_record(out, OpCode::schema, schema); }
void append(Bytes& out, const Channel& channel) { put_record(out, OpCode::channel, channel); }
void append(Bytes& out, const MessageIndex& index) { put_record(out, OpCode::message_index, index); }
void append(Bytes& out, const ChunkIndex& index) { put_record(out, OpCode::chunk_index, index); }
void append(Bytes& out, const AttachmentIndex& index) { put_record(out, OpCode::attachment_index, index); }
void append(Bytes& out, const Metadata& metadata) { put_record(out, OpCode::metadata, metadata); }
void append(Bytes& out, const MetadataIndex& index) { put_record(out, OpCode::metadata_index, index); }
void append(Bytes& out, const Statistics& statistics) { put_record(out, OpCode::statistics, statistics); }
void append(Bytes& out, const SummaryOffset& offset) { put_record(out, OpCode::summary_offset, offset); }
void append(Bytes& out, const DataEnd& end) { put_record(out, OpCode::data_end, end); }

void append(Bytes& out, Footer footer) {
    const std::size_t at = out.size();
    const auto begin = begin_record(out, OpCode::footer);
    put(out, footer.summary_start);
    put(out, footer.summary_offset_start);
    end_record(out, begin, 4);
    put(out, crc32(ByteView(out).subspan(at), footer.summary_crc));
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
    put_record(out, OpCode::chunk, chunk, chunk.stored_size);
}

void append_head(Bytes& out, const AttachmentHead& attachment, std::uint64_t data_size) {
    const auto begin = begin_record(out, OpCode::attachment);
    put_fields(out, attachment);
    put(out, data_size);
    end_record(out, begin, data_size + 4);
}

} // namespace tandem::mcap
