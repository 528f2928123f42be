// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/write/chunk_builder.hpp"

namespace tandem::mcap {

/// Which records a writer repeats behind the data (specification: "Summary Section", "Summary Offset Section"). Readers
/// need all of them to find messages without reading the whole file.
struct SummaryParts {
    bool schemas = true, channels = true, statistics = true, metadata_indexes = true,
         attachment_indexes = true, chunk_indexes = true, offsets = true;
};

/// Collects, while a file is written, the summary that follows its data. Indexes are kept encoded: a chunk takes about
/// 100 bytes, and 10 for each of its channels.
class SummaryBuilder {
  public:
    explicit SummaryBuilder(const SummaryParts& parts) : parts_(parts) {}
    void add_schema(ByteView record);
    void add_channel(ByteView record);
    void add_message(std::uint16_t channel, std::uint64_t log_time);
    void add(const ChunkIndex& index);
    void add(const AttachmentIndex& index);
    void add(const MetadataIndex& index);

    /// The summary, its offsets and the footer as the bytes that follow the data section, which ends at `offset`.
    Bytes finish(std::uint64_t offset);

  private:
    Statistics counted() const;

    SummaryParts parts_;
    Statistics statistics_;
    TimeRange times_;
    std::vector<std::uint64_t> message_counts_; // by channel
    Bytes schemas_, channels_, chunks_, attachments_, metadata_;
};

} // namespace tandem::mcap
