// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/writer.hpp"

#include "apps/tandem/mcap/format/crc32.hpp"
#include "apps/tandem/mcap/format/encode.hpp"

namespace tandem::mcap {
namespace {

constexpr std::uint32_t max_ids = 65'535;          // ids are u16, and schema ids are not 0
constexpr std::size_t max_chunk_size = 1UL << 30U; // its message index must fit into a u32 length

constexpr std::size_t max_chunk_head = 128; // record head, fields, and the name of the compression

/// Returns the id after `count` others.
std::uint16_t next_id(std::uint32_t count, const char* what) {
    if (count == max_ids) throw Error("MCAP: a file has at most 65535 " + std::string(what));
    return static_cast<std::uint16_t>(count + 1);
}

} // namespace

McapWriter::McapWriter(Sink& sink, WriterOptions options)
    : sink_(sink), options_(std::move(options)), compressor_(options_.compression),
      summary_(options_.summary) {
    if (options_.chunk_size > max_chunk_size) throw Error("MCAP: a chunk is limited to 1 GiB");
    output(std::as_bytes(std::span(magic)));
    append(scratch_, Header{options_.profile, options_.library});
    output(scratch_);
    set_mark();
}

McapWriter::~McapWriter() = default;

std::uint16_t McapWriter::add_schema(std::string name, std::string encoding, ByteView data) {
    require_open();
    const Schema schema{
        next_id(schemas_, "schemas"), std::move(name), std::move(encoding), {data.begin(), data.end()}};
    add_definition(schema);
    summary_.add_schema(scratch_);
    ++schemas_;
    return schema.id;
}

std::uint16_t McapWriter::add_channel(std::string topic, std::uint16_t schema, std::string message_encoding,
                                      StringMap metadata) {
    require_open();
    if (schema > schemas_)
        throw Error("MCAP: the channel " + topic + " has the schema " + std::to_string(schema) +
                    ", which was not added");
    const Channel channel{next_id(channels_, "channels"), schema, std::move(topic),
                          std::move(message_encoding), std::move(metadata)};
    add_definition(channel);
    summary_.add_channel(scratch_);
    ++channels_;
    return channel.id;
}

// Specification, "Use of chunk records": schemas, channels and messages are all in chunks, or all directly in the data
// section. An unencodable definition is refused before anything changes.
template <typename Definition>
void McapWriter::add_definition(const Definition& definition) {
    scratch_.clear();
    append(scratch_, definition);
    if (options_.chunk_size > 0)
        chunk_.add_definition(scratch_);
    else
        output(scratch_);
}

void McapWriter::write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t log_time,
                       std::uint64_t publish_time, ByteView data) {
    require_open();
    if (channel == 0 || channel > channels_)
        throw Error("MCAP: a message on channel " + std::to_string(channel) + ", which was not added");
    const Message message{channel, sequence, log_time, publish_time, data};
    if (options_.chunk_size == 0) {
        scratch_.clear();
        append(scratch_, message);
        output(scratch_);
    } else {
        const std::size_t size = record_head_size + message_head_size + data.size();
        if (!chunk_.empty() && chunk_.records().size() + size > options_.chunk_size) end_chunk();
        chunk_.add(message);
    }
    summary_.add_message(channel, log_time);
}

void McapWriter::attach(const std::string& name, const std::string& media_type, std::uint64_t log_time,
                        std::uint64_t create_time, ByteView data) {
    require_open();
    const AttachmentHead head{log_time, create_time, name, media_type};
    scratch_.clear();
    append_head(scratch_, head, data.size());
    const auto crc = little_endian(crc32(data, crc32(ByteView(scratch_).subspan(record_head_size))));
    const std::uint64_t offset = position_;
    sink_.reserve(2 * scratch_.size() + data.size() + summary_.max_size()); // the index repeats the head
    output(scratch_);
    output(data);
    output(crc);
    summary_.add(AttachmentIndex{offset, position_ - offset, head, data.size()});
}

void McapWriter::add_metadata(const std::string& name, const StringMap& metadata) {
    require_open();
    scratch_.clear();
    append(scratch_, Metadata{name, metadata});
    const std::uint64_t offset = position_;
    sink_.reserve(2 * scratch_.size() + summary_.max_size());
    output(scratch_);
    summary_.add(MetadataIndex{offset, position_ - offset, name});
}

void McapWriter::flush() {
    require_open();
    end_chunk();
    sink_.flush();
    set_mark();
}

void McapWriter::close() {
    flush();
    closed_ = true;
    finish();
}

McapWriter::Rest McapWriter::end_at_last_chunk() {
    const std::uint64_t written = summary_.messages();
    closed_ = true;
    summary_.return_to(mark_.summary);
    position_ = mark_.position;
    crc_ = mark_.crc;
    Rest rest{.closed = false, .messages = messages(), .lost_messages = written - messages()};
    if (!sink_.truncate(mark_.position)) return rest;
    try {
        finish();
        rest.closed = true;
    } catch (const Error&) { // no room, even for the end: readers find the records without it
        sink_.truncate(mark_.position);
    }
    return rest;
}

void McapWriter::finish() {
    scratch_.clear();
    append(scratch_, DataEnd{crc_});
    output(scratch_);
    output(summary_.finish(position_));
    output(std::as_bytes(std::span(magic)));
    sink_.flush();
}

void McapWriter::set_mark() {
    mark_.position = position_;
    mark_.crc = crc_;
    summary_.set_mark(mark_.summary);
}

void McapWriter::require_open() const {
    if (closed_) throw Error("MCAP: the file has been closed");
}

void McapWriter::end_chunk() {
    if (chunk_.empty()) return;
    const ByteView records = chunk_.records();
    ByteView stored = compressor_.compress(records);
    const bool smaller = stored.size() < records.size();
    if (!smaller) stored = records;
    const std::string compression = smaller ? compression_name(options_.compression) : "";
    const std::uint64_t start = chunk_.times().start(), end = chunk_.times().end();

    sink_.reserve(max_chunk_head + stored.size() + chunk_.max_index_size() + summary_.max_size());
    ChunkIndex index{start, end, position_, 0, {}, 0, compression, stored.size(), records.size()};
    scratch_.clear();
    append_head(scratch_, ChunkHead{start, end, records.size(), crc32(records), compression, stored.size()});
    output(scratch_);
    output(stored);
    index.chunk_length = position_ - index.chunk_offset;

    scratch_.clear();
    if (options_.message_indexes)
        chunk_.for_each_index([&](const MessageIndex& messages) {
            index.message_index_offsets.emplace_back(messages.channel_id, position_ + scratch_.size());
            append(scratch_, messages);
        });
    output(scratch_);
    index.message_index_length = scratch_.size();
    sink_.flush();
    summary_.add(index);
    chunk_.clear();
    set_mark();
}

void McapWriter::output(ByteView bytes) {
    sink_.write(bytes);
    crc_ = crc32(bytes, crc_);
    position_ += bytes.size();
}

} // namespace tandem::mcap
