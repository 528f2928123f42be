// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/bag/commands.hpp"
#include "apps/tandem/bag/losses.hpp"
#include "apps/tandem/bag/topics.hpp"
#include "apps/tandem/mcap/reader.hpp"
#include "apps/tandem/observe/message_json.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "host/process/output_file.hpp"
#include "host/text/join.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

using Json = nlohmann::ordered_json;

/// Length of the header before a CDR message (OMG DDSI-RTPS 2.5, section 10.2.1.2).
constexpr std::size_t encapsulation_bytes = 4;

/// Decodes the messages of recordings that `tandem record` wrote. The channel's metadata contains the
/// signature.
class MessageDecoder {
  public:
    /// Throws std::runtime_error if another program wrote one of the channels.
    MessageDecoder(const mcap::Contents& contents, const std::set<std::uint16_t>& channels, Losses& losses)
        : contents_(contents), losses_(losses) {
        for (const std::uint16_t id : channels) {
            const auto& channel = contents.channels.at(id);
            const auto signature = channel.metadata.find("tandem.signature");
            if (channel.message_encoding != "cdr" || signature == channel.metadata.end())
                throw std::runtime_error(
                    fmt::format("topic {} cannot be converted: tandem record did not record it from a port, "
                                "so it has no type signature; choose other topics with --topic",
                                channel.topic));
            types_.emplace(id, wire::parse_signature(signature->second));
        }
    }

    const std::string& topic(const mcap::Message& message) const {
        return contents_.channels.at(message.channel_id).topic;
    }
    /// Returns nullopt, and adds the loss of the topic's first one, if the bytes are not a message of the channel's type.
    std::optional<Json> value(const mcap::Message& message) {
        const auto bytes = message.data;
        try {
            if (bytes.size() < encapsulation_bytes || bytes[0] != std::byte{0} || bytes[1] != std::byte{1})
                throw std::runtime_error("it is not little-endian CDR");
            return message_to_json(types_.at(message.channel_id), bytes.subspan(encapsulation_bytes));
        } catch (const std::runtime_error& error) {
            if (undecodable_.insert(message.channel_id).second)
                losses_.add(fmt::format("message {} of topic {} is skipped: {}", message.sequence,
                                        topic(message), error.what()));
            return std::nullopt;
        }
    }

  private:
    const mcap::Contents& contents_;
    Losses& losses_;
    std::map<std::uint16_t, wire::Type> types_;
    std::set<std::uint16_t> undecodable_; ///< channels
};

std::string dump(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Appends the numbers and texts in a value, each with its path, for example `tm.sec` or `data[3]`.
void flatten(const Json& value, const std::string& path,
             std::vector<std::pair<std::string, std::string>>& cells) {
    if (value.is_object()) {
        for (const auto& [name, member] : value.items())
            flatten(member, path.empty() ? name : path + "." + name, cells);
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i)
            flatten(value[i], fmt::format("{}[{}]", path, i), cells);
    } else {
        cells.emplace_back(path, value.is_string() ? value.get<std::string>() : dump(value));
    }
}

/// Quotes a cell if RFC 4180 requires it.
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

bool is_recording(const std::filesystem::path& file) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) return false; // opening a pipe would block
    std::array<char, sizeof mcap::magic> begin{};
    std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
    return std::memcmp(begin.data(), &mcap::magic, begin.size()) == 0;
}

/// A file, or standard output if the file name is empty.
class Output {
  public:
    explicit Output(const std::filesystem::path& file) : name_(file) {
        if (name_.empty()) return;
        if (is_recording(name_))
            throw std::runtime_error(
                fmt::format("{} is a recording: give another output file", name_.string()));
        file_.reset(fdopen(process::open_output(name_).release(), "w"));
        check(file_ != nullptr);
    }
    void line(const std::string& text) {
        if (name_.empty()) return print_data(text + "\n");
        check(std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size() &&
              std::fputc('\n', file_.get()) != EOF);
    }
    void close() {
        if (!name_.empty()) check(std::fclose(file_.release()) == 0);
    }

  private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    void check(bool success) const {
        if (!success)
            throw std::runtime_error(
                fmt::format("{} cannot be written: {}", name_.string(), std::strerror(errno)));
    }
    std::filesystem::path name_;
    std::unique_ptr<std::FILE, Close> file_;
};

/// Calls `use` with each readable message and its value.
template <typename Use>
void for_each_message(mcap::McapReader& reader, const mcap::Query& query, MessageDecoder& decoder,
                      Losses& losses, Use use) {
    auto cursor = reader.messages(query);
    while (const auto message = cursor.next())
        if (const auto value = decoder.value(*message)) use(*message, *value);
    losses.add(cursor.problems());
}

void write_json(mcap::McapReader& reader, const mcap::Query& query, MessageDecoder& decoder, Losses& losses,
                Output& out) {
    for_each_message(reader, query, decoder, losses, [&](const mcap::Message& message, const Json& value) {
        out.line(dump(Json{{"topic", decoder.topic(message)},
                           {"sequence", message.sequence},
                           {"log_time_ns", message.log_time},
                           {"publish_time_ns", message.publish_time},
                           {"value", value}}));
    });
}

/// Returns the columns of all messages, because the length of a sequence can differ between messages.
std::vector<std::string> columns_of(mcap::McapReader& reader, const mcap::Query& query,
                                    MessageDecoder& decoder, Losses& losses) {
    std::vector<std::string> columns;
    std::map<std::string, std::size_t> known;
    for_each_message(reader, query, decoder, losses, [&](const mcap::Message&, const Json& value) {
        std::vector<std::pair<std::string, std::string>> cells;
        flatten(value, "", cells);
        for (auto& [path, text] : cells)
            if (known.emplace(path, columns.size()).second) columns.push_back(path);
    });
    return columns;
}

void write_csv(mcap::McapReader& reader, const mcap::Query& query, MessageDecoder& decoder, Losses& losses,
               Output& out) {
    const auto columns = columns_of(reader, query, decoder, losses);
    std::string head = "log_time_ns,publish_time_ns,sequence";
    for (const std::string& column : columns) head += "," + csv_cell(column);
    out.line(head);
    for_each_message(reader, query, decoder, losses, [&](const mcap::Message& message, const Json& value) {
        std::vector<std::pair<std::string, std::string>> cells;
        flatten(value, "", cells);
        const std::map<std::string, std::string> by_path(cells.begin(), cells.end());
        std::string line = fmt::format("{},{},{}", message.log_time, message.publish_time, message.sequence);
        for (const std::string& column : columns) {
            const auto cell = by_path.find(column);
            line += "," + (cell == by_path.end() ? "" : csv_cell(cell->second));
        }
        out.line(line);
    });
}

/// Returns the topics of all ports, without the steps of the wall clock.
std::vector<std::string> port_topics(const mcap::Contents& contents) {
    std::vector<std::string> topics;
    for (const auto& [id, channel] : contents.channels)
        if (channel.metadata.contains("tandem.signature") && channel.topic != clock_topic &&
            std::find(topics.begin(), topics.end(), channel.topic) == topics.end())
            topics.push_back(channel.topic);
    return topics;
}

} // namespace

int bag_convert(const BagConvertOptions& options) {
    mcap::McapReader reader(options.file);
    if (!options.csv && !options.json)
        throw std::runtime_error(
            "the format is missing: add --json (a line per message) or --csv (a table of "
            "one topic)");
    Losses losses(options.file);
    losses.add(reader.contents().problems);
    const auto topics = options.topics.empty() ? port_topics(reader.contents()) : options.topics;
    if (topics.empty() && losses.report() != 0) return 1;
    if (topics.empty())
        throw std::runtime_error(options.file.string() +
                                 " has no messages of ports recorded by tandem record");
    if (options.csv && topics.size() != 1)
        throw std::runtime_error(
            fmt::format("--csv writes one topic: choose one with --topic: {}", text::join(topics, ", ")));
    mcap::Query query;
    query.channels = channels_of(reader.contents(), options.file, topics);
    query.in_log_time_order = true;
    MessageDecoder decoder(reader.contents(), *query.channels, losses);
    Output out(options.out);
    if (options.csv)
        write_csv(reader, query, decoder, losses, out);
    else
        write_json(reader, query, decoder, losses, out);
    out.close();
    return losses.report();
}

} // namespace tandem::command
