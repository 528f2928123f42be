// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/check/definitions.hpp"
#include "apps/tandem/mcap/format/time_range.hpp"
#include "apps/tandem/mcap/read/block.hpp"

#include <set>

namespace tandem::mcap {

/// What the data section contains, against which the summary is checked. Places are offsets in the file.
struct DataFacts {
    struct Chunk {
        std::uint64_t length = 0; ///< of the record
        ChunkHead head;
        std::set<std::uint16_t> channels; ///< with messages in it
    };
    Definitions definitions;
    std::map<std::uint64_t, Chunk> chunks;
    std::map<std::uint64_t, AttachmentIndex> attachments;
    std::map<std::uint64_t, MetadataIndex> metadata;
    std::map<std::uint16_t, std::uint64_t> messages; ///< how many, by channel
    TimeRange times;
    bool messages_outside_chunks = false;
};

/// Checks the records of the data section, with what is in the chunks.
class DataSectionCheck {
  public:
    DataSectionCheck(File& file, Findings& findings) : file_(file), findings_(findings) {}
    /// A record that is whole. Throws Error if it is damaged.
    void check(const RecordPlace& place);
    /// After the last record.
    DataFacts finish();

  private:
    using Entries = std::vector<std::pair<std::uint64_t, std::uint64_t>>; // of a MessageIndex

    void check_message(const RecordView& record, Entries* index);
    void check_chunk(const RecordPlace& place);
    void check_message_index(const RecordView& record);
    void check_attachment(const RecordPlace& place);
    void end_indexes();

    File& file_;
    Findings& findings_;
    DataFacts facts_;
    Bytes records_;
    std::uint64_t chunk_offset_ = 0;              // of the last chunk, if its indexes may follow
    std::map<std::uint16_t, Entries> last_chunk_; // what its indexes must say
    std::set<std::uint16_t> indexed_;
    std::uint64_t out_of_order_ = 0;
};

} // namespace tandem::mcap
