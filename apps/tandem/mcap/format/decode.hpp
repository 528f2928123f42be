// SPDX-License-Identifier: Apache-2.0
// Records from bytes that another program wrote, or that are damaged. What follows the known fields of a record is left
// alone (specification, "Records": they may be extended). Nothing outside of the bytes is read, and memory is taken for
// what is there only.
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <optional>

namespace tandem::mcap {

/// Takes fields off the front of a record's content. Throws Error if it is too short.
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

// From a record's content. They throw Error if it is too short.
void parse(ByteView content, Header& header);
void parse(ByteView content, Footer& footer);
void parse(ByteView content, Schema& schema);
void parse(ByteView content, Channel& channel);
void parse(ByteView content, Message& message); ///< its data lie in the content
void parse(ByteView content,
           ChunkHead& chunk); ///< of the content, the front suffices: chunk_head_limit bytes
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

/// A chunk's content before its records is at most this long; a longer name of a compression is refused.
constexpr std::size_t chunk_head_limit = 8 + 8 + 8 + 4 + 4 + 64 + 8;
/// How long it is for this name of a compression.
constexpr std::size_t chunk_head_size(std::size_t compression) { return 8 + 8 + 8 + 4 + 4 + compression + 8; }

/// "Chunk", "record 0x80" ...
std::string record_name(OpCode op);

/// One record of a sequence of them in memory.
struct RecordView {
    OpCode op = OpCode{};
    ByteView content;
    std::uint64_t offset = 0; ///< of its op code
    std::uint64_t size() const { return record_head_size + content.size(); }
};

/// Takes records off the front of a sequence: the uncompressed records of a chunk, the summary.
class RecordSequence {
  public:
    explicit RecordSequence(ByteView records) : records_(records) {}
    /// None at the end, and where the rest is no whole record.
    std::optional<RecordView> next();
    bool torn() const { return position_ < records_.size(); } ///< once there is no next one: bytes are left

  private:
    ByteView records_;
    std::size_t position_ = 0;
};

} // namespace tandem::mcap
