// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/write/chunk_builder.hpp"

#include "apps/tandem/mcap/format/encode.hpp"

namespace tandem::mcap {

void ChunkBuilder::add(const Message& message) {
    if (indexes_.size() <= message.channel_id) indexes_.resize(message.channel_id + std::size_t{1});
    MessageIndex& index = indexes_[message.channel_id];
    if (index.entries.empty()) {
        index.channel_id = message.channel_id;
        channels_.push_back(message.channel_id);
    }
    index.entries.emplace_back(message.log_time, records_.size());
    times_.add(message.log_time);
    append(records_, message);
}

void ChunkBuilder::clear() {
    for (const std::uint16_t channel : channels_) indexes_[channel].entries.clear();
    channels_.clear();
    records_.clear();
    times_ = {};
}

} // namespace tandem::mcap
