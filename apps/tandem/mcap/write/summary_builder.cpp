// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/write/summary_builder.hpp"

#include "apps/tandem/mcap/format/crc32.hpp"
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

std::size_t ChunkBuilder::max_index_size() const {
    constexpr std::size_t head = record_head_size + 2 + 4, entry = 8 + 8;
    std::size_t size = 0;
    for_each_index([&](const MessageIndex& index) { size += head + entry * index.entries.size(); });
    return size;
}

void SummaryBuilder::add_schema(ByteView record) {
    schemas_.insert(schemas_.end(), record.begin(), record.end());
    ++statistics_.schema_count;
}

void SummaryBuilder::add_channel(ByteView record) {
    channels_.insert(channels_.end(), record.begin(), record.end());
    ++statistics_.channel_count;
}

void SummaryBuilder::add_message(std::uint16_t channel, std::uint64_t log_time) {
    ++statistics_.message_count;
    if (message_counts_.size() <= channel) message_counts_.resize(channel + std::size_t{1});
    ++message_counts_[channel];
    times_.add(log_time);
}

void SummaryBuilder::add(const ChunkIndex& index) {
    if (parts_.chunk_indexes) append(chunks_, index);
    ++statistics_.chunk_count;
}

void SummaryBuilder::add(const AttachmentIndex& index) {
    if (parts_.attachment_indexes) append(attachments_, index);
    ++statistics_.attachment_count;
}

void SummaryBuilder::add(const MetadataIndex& index) {
    if (parts_.metadata_indexes) append(metadata_, index);
    ++statistics_.metadata_count;
}

std::size_t SummaryBuilder::max_size() const {
    constexpr std::size_t fixed = 1024;     // statistics, a chunk index, offsets and footer
    constexpr std::size_t per_channel = 20; // in the statistics and in the chunk index
    return fixed + schemas_.size() + channels_.size() + chunks_.size() + attachments_.size() +
           metadata_.size() + per_channel * message_counts_.size();
}

void SummaryBuilder::set_mark(Mark& mark) const {
    mark.statistics = statistics_;
    mark.times = times_;
    mark.message_counts.assign(message_counts_.begin(), message_counts_.end());
    mark.schemas = schemas_.size();
    mark.channels = channels_.size();
    mark.chunks = chunks_.size();
    mark.attachments = attachments_.size();
    mark.metadata = metadata_.size();
}

void SummaryBuilder::return_to(const Mark& mark) {
    statistics_ = mark.statistics;
    times_ = mark.times;
    message_counts_ = mark.message_counts;
    schemas_.resize(mark.schemas);
    channels_.resize(mark.channels);
    chunks_.resize(mark.chunks);
    attachments_.resize(mark.attachments);
    metadata_.resize(mark.metadata);
}

Bytes SummaryBuilder::finish(std::uint64_t offset) {
    Bytes statistics, out;
    append(statistics, counted());
    // "Statistics": channels must come before it. Otherwise the order is that of the reference writers.
    const struct {
        OpCode op;
        bool wanted;
        const Bytes& records;
    } groups[] = {{OpCode::schema, parts_.schemas, schemas_},
                  {OpCode::channel, parts_.channels, channels_},
                  {OpCode::statistics, parts_.statistics, statistics},
                  {OpCode::metadata_index, parts_.metadata_indexes, metadata_},
                  {OpCode::attachment_index, parts_.attachment_indexes, attachments_},
                  {OpCode::chunk_index, parts_.chunk_indexes, chunks_}};
    std::vector<SummaryOffset> offsets;
    for (const auto& group : groups) {
        if (!group.wanted || group.records.empty()) continue;
        offsets.push_back({group.op, offset + out.size(), group.records.size()});
        out.insert(out.end(), group.records.begin(), group.records.end());
    }
    Footer footer{out.empty() ? 0 : offset, 0, 0};
    if (parts_.offsets && !offsets.empty()) {
        footer.summary_offset_start = offset + out.size();
        for (const auto& group : offsets) append(out, group);
    }
    footer.summary_crc = crc32(out);
    append(out, footer);
    return out;
}

Statistics SummaryBuilder::counted() const {
    Statistics statistics = statistics_;
    statistics.start_time = times_.start();
    statistics.end_time = times_.end();
    for (std::size_t channel = 0; channel < message_counts_.size(); ++channel)
        if (message_counts_[channel] > 0)
            statistics.channel_message_counts.emplace_back(channel, message_counts_[channel]);
    return statistics;
}

} // namespace tandem::mcap
