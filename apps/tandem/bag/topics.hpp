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
    std::optional<double> rate_hz;      ///< over the time of the whole file
    std::optional<std::uint64_t> drops; ///< not known of messages that are not numbered
};

/// From the first message to the last; 0 if the file claims that it ends before it begins.
double duration_s(const mcap::Statistics& statistics);

/// Reads, of each channel, the blocks with its first and its last message: their numbers tell how many were sent.
std::vector<BagTopic> topics_of(mcap::McapReader& reader);

/// The channels of these topics, or of all if there are none. Throws std::runtime_error, with the topics that there are, for
/// a topic that the file has not.
std::set<std::uint16_t> channels_of(const mcap::Contents& contents, const std::filesystem::path& file,
                                    const std::vector<std::string>& topics);

} // namespace tandem::command
