// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/check_file.hpp"
#include "apps/tandem/mcap/format/decode.hpp"
#include "apps/tandem/mcap/format/time_range.hpp"
#include "apps/tandem/mcap/read/block.hpp"

#include <fmt/format.h>
#include <set>

namespace tandem::mcap {

/// Collects at most a hundred findings, because a writer can make the same mistake in every record.
class Findings {
  public:
    template <typename... Arguments>
    void error(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        add(true, fmt::format(format, std::forward<Arguments>(arguments)...));
    }
    template <typename... Arguments>
    void warning(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        add(false, fmt::format(format, std::forward<Arguments>(arguments)...));
    }
    /// Adds an error unless the two values are equal.
    template <typename A, typename B>
    void expect_equal(const A& found, const B& expected, const std::string& what) {
        if (!(found == expected)) error("{} is {}, but should be {}", what, found, expected);
    }
    std::vector<Finding> take() { return std::move(findings_); }

  private:
    void add(bool is_error, std::string line) {
        constexpr std::size_t max_lines = 100;
        if (findings_.size() < max_lines)
            findings_.push_back({is_error, std::move(line)});
        else if (findings_.size() == max_lines)
            findings_.push_back({is_error, "... and more"});
        else
            findings_.back().error |= is_error;
    }
    std::vector<Finding> findings_;
};

/// Returns the name of a record for findings.
inline std::string name_of(const RecordView& record) {
    return fmt::format("the {} at byte {}", record_name(record.op), record.offset);
}

/// The schemas and channels of the data section, to compare with those of the summary.
struct Definitions {
    std::map<std::uint16_t, Schema> schemas;
    std::map<std::uint16_t, Channel> channels;
};

/// Check a record by itself and against an earlier record with the same id. Add it if it is new. Throw Error for a
/// damaged record.
void check_schema(const RecordView& record, Definitions& known, Findings& findings);
void check_channel(const RecordView& record, Definitions& known, Findings& findings);

/// Facts about the data section for the check of the summary. Places are offsets in the file.
struct DataFacts {
    struct Chunk {
        std::uint64_t length = 0; ///< length of the record
        ChunkHead head;
        std::set<std::uint16_t> channels; ///< channels with messages in the chunk
    };
    Definitions definitions;
    std::map<std::uint64_t, Chunk> chunks;
    std::map<std::uint64_t, AttachmentIndex> attachments;
    std::map<std::uint64_t, MetadataIndex> metadata;
    std::map<std::uint16_t, std::uint64_t> messages; ///< number of messages by channel
    TimeRange times;
    bool messages_outside_chunks = false;
};

/// Checks the records of the data section and inside its chunks.
class DataSectionCheck {
  public:
    DataSectionCheck(File& file, Findings& findings) : file_(file), findings_(findings) {}
    /// Checks a complete record. Throws Error if it is damaged.
    void check(const RecordPlace& place);
    /// Call this after the last record.
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
    std::uint64_t chunk_offset_ = 0;              // last chunk, while its indexes can follow; else 0
    std::map<std::uint16_t, Entries> last_chunk_; // expected contents of its indexes
    std::set<std::uint16_t> indexed_;
    std::uint64_t out_of_order_ = 0;
};

} // namespace tandem::mcap
