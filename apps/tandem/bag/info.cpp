// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/bag/commands.hpp"
#include "apps/tandem/bag/losses.hpp"
#include "apps/tandem/bag/times.hpp"
#include "apps/tandem/bag/topics.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "host/text/join.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

using nlohmann::json;

/// Totals of the chunks with the same compression; sizes in bytes.
struct Chunks {
    std::uint64_t count = 0, stored = 0, uncompressed = 0;
};

std::map<std::string, Chunks> chunks_of(const mcap::Contents& contents) {
    std::map<std::string, Chunks> found;
    for (const auto& block : contents.blocks) {
        if (!block.chunk) continue;
        Chunks& chunks = found[block.compression.empty() ? "none" : block.compression];
        ++chunks.count;
        chunks.stored += block.length;
        chunks.uncompressed += block.uncompressed_size;
    }
    return found;
}

/// Returns the readable metadata records. Adds a line to `problems` for each unreadable one.
std::vector<mcap::Metadata> metadata_of(mcap::McapReader& reader, std::vector<std::string>& problems) {
    std::vector<mcap::Metadata> found;
    for (const auto& index : reader.contents().metadata) {
        try {
            found.push_back(reader.metadata(index));
        } catch (const mcap::Error& error) {
            problems.emplace_back(error.what());
        }
    }
    return found;
}

json topic_json(const BagTopic& topic) {
    return {{"topic", topic.topic},
            {"messages", topic.count},
            {"rate_hz", topic.rate_hz ? json(*topic.rate_hz) : json()},
            {"drops", topic.drops ? json(*topic.drops) : json()},
            {"schema", topic.schema},
            {"schema_encoding", topic.schema_encoding},
            {"message_encoding", topic.message_encoding},
            {"metadata", topic.metadata}};
}

/// What `bag info` shows.
struct Bag {
    explicit Bag(mcap::McapReader& reader)
        : problems(reader.contents().problems), metadata(metadata_of(reader, problems)),
          topics(topics_of(reader, problems)) {}
    std::vector<std::string> problems;
    std::vector<mcap::Metadata> metadata;
    std::vector<BagTopic> topics;
};

json bag_json(mcap::McapReader& reader, const Bag& bag, const std::filesystem::path& file) {
    const auto& contents = reader.contents();
    json result = {{"file", file.string()},
                   {"bytes", reader.file_size()},
                   {"complete", contents.complete},
                   {"problems", bag.problems},
                   {"library", contents.header.library},
                   {"profile", contents.header.profile},
                   {"messages", contents.statistics.message_count},
                   {"start_ns", contents.statistics.start_time},
                   {"end_ns", contents.statistics.end_time},
                   {"duration_s", duration_s(contents.statistics)},
                   {"chunks", json::array()},
                   {"topics", json::array()},
                   {"attachments", json::array()},
                   {"metadata", json::array()}};
    for (const auto& [compression, chunks] : chunks_of(contents))
        result["chunks"].push_back({{"compression", compression},
                                    {"count", chunks.count},
                                    {"bytes", chunks.stored},
                                    {"uncompressed_bytes", chunks.uncompressed}});
    for (const auto& topic : bag.topics) result["topics"].push_back(topic_json(topic));
    for (const auto& attachment : contents.attachments)
        result["attachments"].push_back({{"name", attachment.attachment.name},
                                         {"media_type", attachment.attachment.media_type},
                                         {"bytes", attachment.data_size},
                                         {"log_time_ns", attachment.attachment.log_time},
                                         {"create_time_ns", attachment.attachment.create_time}});
    for (const auto& record : bag.metadata)
        result["metadata"].push_back({{"name", record.name}, {"values", record.metadata}});
    return result;
}

std::string times_line(const mcap::Statistics& statistics) {
    if (statistics.message_count == 0) return "no messages";
    return fmt::format("{} .. {}, {:.6g} s", format_time(statistics.start_time),
                       format_time(statistics.end_time), duration_s(statistics));
}

std::string chunks_line(const mcap::Contents& contents) {
    const std::string line = text::join(chunks_of(contents), "; ", [](const auto& each) {
        const auto& [compression, chunks] = each;
        return fmt::format("{} ({}): {} for {}", chunks.count, compression, format_bytes(chunks.stored),
                           format_bytes(chunks.uncompressed));
    });
    return line.empty() ? "none" : line;
}

std::string head(mcap::McapReader& reader, const Bag& bag, const std::filesystem::path& file) {
    const auto& contents = reader.contents();
    const auto line = [](const char* name, const std::string& value) {
        return fmt::format("{:<12}{}\n", name, replace_control_characters(value));
    };
    std::string text = line("file", file.string() + ", " + format_bytes(reader.file_size()));
    text += line("complete", contents.complete ? "yes" : "no");
    for (const auto& problem : bag.problems) text += line("problem", problem);
    text += line("library", contents.header.library);
    if (!contents.header.profile.empty()) text += line("profile", contents.header.profile);
    text += line("recorded", times_line(contents.statistics));
    text += line("messages", std::to_string(contents.statistics.message_count));
    text += line("chunks", chunks_line(contents));
    for (const auto& attachment : contents.attachments)
        text += line("attachment",
                     fmt::format("{} ({}), {}", attachment.attachment.name, attachment.attachment.media_type,
                                 format_bytes(attachment.data_size)));
    constexpr std::size_t longest = 300; // longer values, such as port tables, are for programs
    for (const auto& record : bag.metadata)
        for (const auto& [key, value] : record.metadata)
            text += line("metadata",
                         value.size() <= longest
                             ? fmt::format("{}: {} = {}", record.name, key, value)
                             : fmt::format("{}: {}, {}", record.name, key, format_bytes(value.size())));
    return text;
}

} // namespace

int bag_info(const std::filesystem::path& file, bool json) {
    mcap::McapReader reader(file);
    const Bag bag(reader);
    Losses losses(file);
    losses.add(bag.problems);
    if (json) {
        print_json(bag_json(reader, bag, file));
        return losses.report();
    }
    Table table({"TOPIC", ">MESSAGES", ">RATE", ">DROPS", "SCHEMA", "SCHEMA ENCODING", "ENCODING"});
    for (const auto& topic : bag.topics) {
        const auto or_dash = [](const std::string& text) {
            return text.empty() ? std::string("-") : replace_control_characters(text);
        };
        table.add_row({or_dash(topic.topic), std::to_string(topic.count),
                       topic.rate_hz ? fmt::format("{:.4g} Hz", *topic.rate_hz) : "-",
                       topic.drops ? std::to_string(*topic.drops) : "-", or_dash(topic.schema),
                       or_dash(topic.schema_encoding), or_dash(topic.message_encoding)});
    }
    print_text(head(reader, bag, file) + (table.empty() ? "" : "\n" + table.text()));
    return losses.report();
}

} // namespace tandem::command
