// SPDX-License-Identifier: Apache-2.0
// Decodes records that another program wrote or that are damaged. Ignores bytes after a record's known fields, because
// the specification allows extensions ("Records"). Reads nothing outside of the bytes and allocates memory only for
// existing data.
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <optional>

namespace tandem::mcap {

/// Removes fields from the front of a record's content. Throws Error if the content is too short.
class FieldReader {
  public:
    explicit FieldReader(ByteView content) : rest_(content) {}
    ByteView take(std::uint64_t size);
    template <typename Number>
    Number number() {
        Number value = 0;
        std::size_t shift = 0;
        for (const std::byte byte : take(sizeof(Number)))
            value |= static_cast<Number>(Number(byte) << (8 * shift++));
        return value;
    }
    std::string text();
    StringMap map();
    ByteView rest() const { return rest_; }

  private:
    ByteView rest_;
};

// Parse a record's content. Throw Error if it is too short.
void parse(ByteView content, Header& header);
void parse(ByteView content, Footer& footer);
void parse(ByteView content, Schema& schema);
void parse(ByteView content, Channel& channel);
void parse(ByteView content, Message& message); ///< its data point into `content`
void parse(ByteView content,
           ChunkHead& chunk); ///< the first chunk_head_limit bytes of the content suffice
void parse(ByteView content, MessageIndex& index);
void parse(ByteView content, ChunkIndex& index);
void parse(ByteView content, AttachmentIndex& index);
void parse(ByteView content, Metadata& metadata);
void parse(ByteView content, MetadataIndex& index);
void parse(ByteView content, Statistics& statistics);
void parse(ByteView content, SummaryOffset& offset);
void parse(ByteView content, DataEnd& end);
template <typename Record>
Record parsed(ByteView content) {
    Record record;
    parse(content, record);
    return record;
}

/// Maximum length of a chunk's content before its records. Longer names of a compression are refused.
constexpr std::size_t chunk_head_limit = 8 + 8 + 8 + 4 + 4 + 64 + 8;
/// Length for a compression name of `compression` bytes.
constexpr std::size_t chunk_head_size(std::size_t compression) { return 8 + 8 + 8 + 4 + 4 + compression + 8; }

/// Returns "Chunk", "record 0x80" and so on.
std::string record_name(OpCode op);

/// A record of a sequence in memory.
struct RecordView {
    OpCode op = OpCode{};
    ByteView content;
    std::uint64_t offset = 0; ///< of its op code
    std::uint64_t size() const { return record_head_size + content.size(); }
};

/// Removes records from the front of a sequence, for example the uncompressed records of a chunk, or the summary.
class RecordSequence {
  public:
    explicit RecordSequence(ByteView records) : records_(records) {}
    /// Returns nullopt at the end, or if the rest is not a complete record.
    std::optional<RecordView> next();
    bool torn() const { return position_ < records_.size(); } ///< after the last record: bytes are left

  private:
    ByteView records_;
    std::size_t position_ = 0;
};

} // namespace tandem::mcap
