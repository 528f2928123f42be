// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/write/chunk_builder.hpp"

namespace tandem::mcap {

/// Selects the records that a writer repeats after the data (specification: "Summary Section", "Summary Offset
/// Section"). Without all of them, readers must read the whole file to find messages.
struct SummaryParts {
    bool schemas = true, channels = true, statistics = true, metadata_indexes = true,
         attachment_indexes = true, chunk_indexes = true, offsets = true;
};

/// Collects the summary while a file is written. Keeps indexes encoded: about 100 bytes per chunk, and 10 for each of
/// its channels.
class SummaryBuilder {
  public:
    explicit SummaryBuilder(const SummaryParts& parts) : parts_(parts) {}
    void add_schema(ByteView record);
    void add_channel(ByteView record);
    void add_message(std::uint16_t channel, std::uint64_t log_time);
    void add(const ChunkIndex& index);
    void add(const AttachmentIndex& index);
    void add(const MetadataIndex& index);

    /// Returns the summary, its offsets and the footer, to write after the data section. `offset`: end of the data
    /// section.
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
