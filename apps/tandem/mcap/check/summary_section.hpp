// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/check/data_section.hpp"

namespace tandem::mcap {

/// Checks the records after the data section against the data section.
class SummarySectionCheck {
  public:
    SummarySectionCheck(DataFacts& facts, Findings& findings) : facts_(facts), findings_(findings) {}
    /// Checks a record of the summary or of the summary offsets. Throws Error if it is damaged.
    void check(const RecordView& record);
    /// Call this after the last record.
    void finish();

  private:
    void check_definition(const RecordView& record);
    void check_chunk_index(const RecordView& record);
    void check_statistics(const RecordView& record);
    void check_offset(const RecordView& record);
    template <typename Index>
    void check_index(const RecordView& record, const std::map<std::uint64_t, Index>& known,
                     std::size_t& count);

    struct Group {
        std::uint64_t start = 0, length = 0;
    };
    DataFacts& facts_;
    Findings& findings_;
    std::map<OpCode, Group> groups_;
    OpCode last_ = OpCode{};
    std::set<std::uint16_t> schemas_, channels_;
    std::set<std::uint64_t> chunks_;
    std::size_t attachments_ = 0, metadata_ = 0;
};

} // namespace tandem::mcap
