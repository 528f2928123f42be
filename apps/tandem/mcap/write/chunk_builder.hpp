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

} // namespace tandem::mcap
