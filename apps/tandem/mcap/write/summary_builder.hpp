// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/format/time_range.hpp"
#include "apps/tandem/mcap/records.hpp"

namespace tandem::mcap {

/// The records of the chunk that a writer is filling, and the index of its messages. clear() keeps the memory.
class ChunkBuilder {
  public:
    /// Adds the record of a schema or a channel.
    void add_definition(ByteView record) { records_.insert(records_.end(), record.begin(), record.end()); }
    /// The channel must be defined before, in this chunk or earlier in the file.
    void add(const Message& message);
    void clear();

    bool empty() const { return records_.empty(); }
    ByteView records() const { return records_; }
    const TimeRange& times() const { return times_; }
    /// Returns an upper bound for the size of the index records of all channels.
    std::size_t max_index_size() const;
    /// Calls `use` with the index of each channel with messages, in the order of their first messages.
    template <typename Use>
    void for_each_index(Use use) const {
        for (const std::uint16_t channel : channels_) use(indexes_[channel]);
    }

  private:
    Bytes records_;
    TimeRange times_;
    std::vector<MessageIndex> indexes_;   // by channel
    std::vector<std::uint16_t> channels_; // channels with messages
};

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

    std::uint64_t messages() const { return statistics_.message_count; }
    /// Returns an upper bound for the size of finish() after one more chunk.
    std::size_t max_size() const;

    /// What has been added so far.
    struct Mark {
        Statistics statistics;
        TimeRange times;
        std::vector<std::uint64_t> message_counts;
        std::size_t schemas = 0, channels = 0, chunks = 0, attachments = 0, metadata = 0; ///< bytes
    };
    void set_mark(Mark& mark) const; ///< Reuses the memory of the mark.
    void return_to(const Mark& mark);

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
