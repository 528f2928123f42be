// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/bag/topics.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

/// The sequence numbers of a channel's first and last message.
struct Numbers {
    std::optional<std::uint32_t> first, last;
};

std::map<std::uint16_t, Numbers> sequence_ranges(mcap::McapReader& reader,
                                                 std::vector<std::string>& problems) {
    std::map<std::size_t, std::set<std::uint16_t>> blocks; // that contain a channel's first or last message
    for (const auto& [channel, places] : reader.contents().blocks_of_channel) {
        blocks[places.first].insert(channel);
        blocks[places.second].insert(channel);
    }
    std::map<std::uint16_t, Numbers> numbers;
    mcap::Bytes records;
    for (const auto& [block, channels] : blocks) {
        try {
            mcap::load(reader.file(), reader.contents().blocks[block], records);
        } catch (const mcap::Error& error) { // the drops are unknown
            const auto at = reader.contents().blocks[block].offset;
            problems.emplace_back(
                reader.file()
                    .error(fmt::format("the Chunk at byte {} {}: its messages are lost", at, error.what()))
                    .what());
            for (const auto channel : channels) numbers[channel] = {};
            continue;
        }
        mcap::RecordSequence sequence(records);
        while (const auto record = sequence.next()) {
            if (record->op != mcap::OpCode::message || record->content.size() < mcap::message_head_size)
                continue;
            const auto message = mcap::parsed<mcap::Message>(record->content);
            if (!channels.contains(message.channel_id)) continue;
            auto& [first, last] = numbers[message.channel_id];
            if (!first) first = message.sequence;
            last = message.sequence;
        }
    }
    return numbers;
}

/// Returns the number of missing messages. Returns nullopt unless the range of sequence numbers fits at least
/// `count` messages. The counter may start at any value.
std::optional<std::uint64_t> drops_of(const Numbers& numbers, std::uint64_t count) {
    if (!numbers.first || !numbers.last) return {};
    // Unsigned 32-bit arithmetic, because the counter may wrap. A larger distance means that the counter
    // restarted.
    const std::uint32_t distance = *numbers.last - *numbers.first;
    const std::uint64_t sent = std::uint64_t{distance} + 1;
    if (sent < count || distance > std::numeric_limits<std::uint32_t>::max() / 2) return {};
    return sent - count;
}

} // namespace

double duration_s(const mcap::Statistics& statistics) {
    if (statistics.end_time < statistics.start_time) return 0;
    return static_cast<double>(statistics.end_time - statistics.start_time) / 1e9;
}

std::vector<BagTopic> topics_of(mcap::McapReader& reader, std::vector<std::string>& problems) {
    const auto& contents = reader.contents();
    const auto& statistics = contents.statistics;
    const std::map<std::uint16_t, std::uint64_t> counts(statistics.channel_message_counts.begin(),
                                                        statistics.channel_message_counts.end());
    const auto numbers = sequence_ranges(reader, problems);
    const double duration = duration_s(statistics);
    std::vector<BagTopic> topics;
    for (const auto& [id, channel] : contents.channels) {
        BagTopic topic{channel.topic, "", "", channel.message_encoding, channel.metadata, 0, {}, {}};
        const auto schema = contents.schemas.find(channel.schema_id);
        if (schema != contents.schemas.end()) {
            topic.schema = schema->second.name;
            topic.schema_encoding = schema->second.encoding;
        }
        if (counts.contains(id)) topic.count = counts.at(id);
        if (topic.count > 1 && duration > 0) topic.rate_hz = static_cast<double>(topic.count - 1) / duration;
        if (numbers.contains(id)) topic.drops = drops_of(numbers.at(id), topic.count);
        topics.push_back(std::move(topic));
    }
    return topics;
}

std::set<std::uint16_t> channels_of(const mcap::Contents& contents, const std::filesystem::path& file,
                                    const std::vector<std::string>& topics) {
    std::set<std::uint16_t> channels;
    for (const auto& topic : topics) {
        const std::size_t before = channels.size();
        std::string known;
        for (const auto& [id, channel] : contents.channels) {
            if (channel.topic == topic) channels.insert(id);
            known += (known.empty() ? "" : ", ") + channel.topic;
        }
        if (channels.size() == before)
            throw std::runtime_error(
                fmt::format("{} has no topic {}: it has {}", file.string(), topic, known));
    }
    if (topics.empty())
        for (const auto& [id, channel] : contents.channels) channels.insert(id);
    return channels;
}

} // namespace tandem::command
