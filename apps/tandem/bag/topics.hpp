// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/reader.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tandem::command {

/// A channel of a recording, as `bag info` shows it.
struct BagTopic {
    std::string topic, schema, schema_encoding, message_encoding;
    mcap::StringMap metadata;
    std::uint64_t count = 0;
    std::optional<double> rate_hz;      ///< average over the duration of the whole file
    std::optional<std::uint64_t> drops; ///< nullopt if the messages are not numbered
};

/// Returns the time from the first message to the last one; 0 if the file claims an end before its start.
double duration_s(const mcap::Statistics& statistics);

/// Returns the channels of a recording. Reads the blocks with each channel's first and last message: their
/// sequence numbers show how many messages were sent. Adds a line to `problems` for each unreadable block.
std::vector<BagTopic> topics_of(mcap::McapReader& reader, std::vector<std::string>& problems);

/// Returns the channels of these topics, or all channels if `topics` is empty. Throws std::runtime_error with
/// a list of the existing topics if the file does not contain a topic.
std::set<std::uint16_t> channels_of(const mcap::Contents& contents, const std::filesystem::path& file,
                                    const std::vector<std::string>& topics);

} // namespace tandem::command
