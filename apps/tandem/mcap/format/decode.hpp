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
    ByteView rest() const { return rest_; }

  private:
    ByteView rest_;
};

/// Parses the content of a record. Throws Error if it is too short. A message's data point into `content`. The first
/// chunk_head_limit bytes of a chunk suffice.
template <typename Record>
Record parsed(ByteView content);

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
    bool torn() const { return position_ < records_.size(); } ///< an incomplete record is left

  private:
    ByteView records_;
    std::size_t position_ = 0;
};

} // namespace tandem::mcap
