// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/bag/commands.hpp"
#include "apps/tandem/bag/losses.hpp"
#include "apps/tandem/bag/times.hpp"
#include "apps/tandem/bag/topics.hpp"
#include "apps/tandem/mcap/reader.hpp"
#include "apps/tandem/mcap/writer.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"

#include <fmt/format.h>
#include <tandem_version.hpp>

namespace tandem::command {
namespace {

/// Returns the compression of the first compressed chunk.
mcap::Compression compression_of(const mcap::Contents& contents) {
    for (const auto& block : contents.blocks)
        for (const auto compression : {mcap::Compression::lz4, mcap::Compression::zstd})
            if (block.compression == mcap::compression_name(compression)) return compression;
    return mcap::Compression::none;
}

mcap::Query query_of(const mcap::Contents& contents, const BagCutOptions& options) {
    mcap::Query query;
    const std::uint64_t begin = contents.statistics.start_time;
    if (!options.from.empty()) query.from = parse_time(options.from, begin, "--from");
    if (!options.to.empty()) query.to = parse_time(options.to, begin, "--to");
    if (query.from > query.to)
        throw std::runtime_error("--to " + options.to + " is before --from " + options.from);
    query.channels = channels_of(contents, options.file, options.topics);
    return query;
}

/// Adds the schemas and channels of the cut to the new file. Maps each old channel id to the new one.
std::map<std::uint16_t, std::uint16_t> define(mcap::McapWriter& writer, const mcap::Contents& contents,
                                              const std::set<std::uint16_t>& channels) {
    std::map<std::uint16_t, std::uint16_t> schemas, ids;
    for (const std::uint16_t id : channels) {
        const auto& channel = contents.channels.at(id);
        const auto schema = contents.schemas.find(channel.schema_id);
        if (schema != contents.schemas.end() && !schemas.contains(channel.schema_id))
            schemas[channel.schema_id] =
                writer.add_schema(schema->second.name, schema->second.encoding, schema->second.data);
        ids[id] = writer.add_channel(channel.topic, schemas[channel.schema_id], channel.message_encoding,
                                     channel.metadata);
    }
    return ids;
}

/// Calls `read` with each index and `write` with the result. Skips what cannot be read.
template <typename Index, typename Read, typename Write>
void copy_each(const std::vector<Index>& indexes, Losses& losses, Read read, Write write) {
    for (const auto& index : indexes) {
        std::optional<std::invoke_result_t<Read, const Index&>> found;
        try {
            found = read(index);
        } catch (const mcap::Error& error) {
            losses.add(std::string(error.what()) + ": it is left out");
            continue;
        }
        write(index, *found);
    }
}

/// Returns the number of copied messages.
std::uint64_t copy(mcap::McapReader& reader, const mcap::Query& query, mcap::McapWriter& writer,
                   Losses& losses) {
    const auto& contents = reader.contents();
    const auto ids = define(writer, contents, *query.channels);
    copy_each(
        contents.metadata, losses, [&](const auto& index) { return reader.metadata(index); },
        [&](const auto&, const mcap::Metadata& record) {
            writer.add_metadata(record.name, record.metadata);
        });
    std::uint64_t count = 0;
    auto messages = reader.messages(query);
    while (const auto message = messages.next()) {
        writer.write(ids.at(message->channel_id), message->sequence, message->log_time, message->publish_time,
                     message->data);
        ++count;
    }
    copy_each(
        contents.attachments, losses, [&](const auto& index) { return reader.attachment_data(index); },
        [&](const mcap::AttachmentIndex& index, const mcap::Bytes& data) {
            const auto& head = index.attachment;
            writer.attach(head.name, head.media_type, head.log_time, head.create_time, data);
        });
    writer.close();
    losses.add(messages.problems());
    return count;
}

} // namespace

int bag_cut(const BagCutOptions& options) {
    mcap::McapReader reader(options.file);
    std::error_code ignored; // the output may not exist
    if (std::filesystem::equivalent(options.file, options.out, ignored))
        throw std::runtime_error(options.out.string() + " is the recording itself: give another output file");
    const auto query = query_of(reader.contents(), options);
    Losses losses(options.file);
    losses.add(reader.contents().problems);
    // An error leaves no file.
    mcap::FileSink sink(options.out, mcap::NewFile::Named::when_complete);
    mcap::McapWriter writer(sink, {.library = std::string("tandem ") + version,
                                   .profile = reader.contents().header.profile,
                                   .compression = compression_of(reader.contents())});
    const std::uint64_t count = copy(reader, query, writer, losses);
    sink.close();
    print_text(fmt::format("{}: {} messages of {} topics, {}\n", options.out.string(), count,
                           query.channels->size(), format_bytes(writer.bytes_written())));
    return losses.report();
}

} // namespace tandem::command
