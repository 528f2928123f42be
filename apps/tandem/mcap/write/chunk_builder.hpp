// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/format/time_range.hpp"
#include "apps/tandem/mcap/records.hpp"

namespace tandem::mcap {

/// The records of the chunk that a writer is filling, and the index of its messages. It keeps its memory when it is
/// cleared.
class ChunkBuilder {
  public:
    /// A record of a schema or a channel.
    void add_definition(ByteView record) { records_.insert(records_.end(), record.begin(), record.end()); }
    /// Its channel has been defined, here or earlier in the file.
    void add(const Message& message);
    void clear();

    bool empty() const { return records_.empty(); }
    ByteView records() const { return records_; }
    const TimeRange& times() const { return times_; }
    /// Calls `use` with the index of each channel that has a message here, in the order of their first ones.
    template <typename Use>
    void for_each_index(Use use) const {
        for (const std::uint16_t channel : channels_) use(indexes_[channel]);
    }

  private:
    Bytes records_;
    TimeRange times_;
    std::vector<MessageIndex> indexes_;   // by channel
    std::vector<std::uint16_t> channels_; // with messages
};

} // namespace tandem::mcap
