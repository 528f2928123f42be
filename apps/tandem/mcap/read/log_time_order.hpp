// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/message_cursor.hpp"

namespace tandem::mcap {

/// Merges the messages of blocks by log time. Loads a block when no earlier message is left.
class LogTimeOrder : public MessageOrder {
  public:
    explicit LogTimeOrder(BlockReader& blocks);
    std::optional<Message> next() override;

  private:
    /// A message in its block's records.
    struct Place {
        std::uint64_t log_time;
        std::size_t offset;
    };
    struct Loaded {
        const Block* block = nullptr;
        Bytes records;
        std::vector<Place> places; // ordered by time
        std::size_t next = 0;
    };
    using LoadedBlock = std::unique_ptr<Loaded>;
    static bool later(const LoadedBlock& a, const LoadedBlock& b);
    void load_next();
    Error too_much() const;

    BlockReader& blocks_;
    std::vector<const Block*> waiting_; // the last one is next
    std::vector<LoadedBlock> heap_;     // the block with the earliest message is first
    LoadedBlock delivered_;             // keeps the data of the last message valid
    std::uint64_t loaded_bytes_ = 0;
};

} // namespace tandem::mcap
