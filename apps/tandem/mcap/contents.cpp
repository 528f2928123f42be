// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/contents.hpp"

#include "apps/tandem/mcap/format/decode.hpp"
#include "apps/tandem/mcap/format/time_range.hpp"
#include "apps/tandem/mcap/read/problems.hpp"
#include "apps/tandem/mcap/read/summary.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace tandem::mcap {
namespace {

constexpr std::uint64_t max_run = 1 << 20; // block size for messages outside of chunks
constexpr std::uint64_t max_definitions =
    256UL << 20U; // limit, because compressed chunks can contain more schemas than fit into memory
constexpr std::uint64_t max_fields = std::uint64_t{64} * 1024; // limit for names of attachments and metadata

class Scan {
  public:
    Scan(File& file, Contents& contents) : file_(file), contents_(contents) {}

    bool run(std::uint64_t position) {
        while (const auto record = file_.record_at(position)) {
            if (record->op == OpCode::data_end || record->op == OpCode::footer) return finish(true);
            if (record->op == OpCode{}) {
                problem("is damaged at byte {}: the rest is not read", position);
                return finish(false);
            }
            if (!file_.holds(*record)) {
                cut(*record);
                return finish(false);
            }
            try {
                visit(*record);
            } catch (const Error& error) {
                problem("the {} at byte {} {}: it is skipped", record_name(record->op), position,
                        error.what());
            }
            position = record->content() + record->length;
        }
        if (position == file_.size())
            problem("ends at byte {} without a DataEnd record: the recorder did not close it", position);
        else
            problem("is truncated at byte {}, in the head of a record", file_.size());
        return finish(false);
    }

  private:
    template <typename... Arguments>
    void problem(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        add_problem(contents_.problems,
                    file_.error(fmt::format(format, std::forward<Arguments>(arguments)...)).what());
    }

    void visit(const RecordPlace& record) {
        switch (record.op) {
        case OpCode::schema:
        case OpCode::channel:
            define({record.op, file_.content_of(record), record.offset});
            break;
        case OpCode::message:
            add_message(record);
            break;
        case OpCode::chunk:
            add_chunk(record);
            break;
        case OpCode::attachment: {
            const auto place = attachment_at(file_, record);
            contents_.attachments.push_back(
                {record.offset, record_head_size + record.length, place.head, place.data_size});
            break;
        }
        case OpCode::metadata: {
            const auto front = std::min(record.length, max_fields);
            contents_.metadata.push_back({record.offset, record_head_size + record.length,
                                          FieldReader(file_.read(record.content(), front)).text()});
            break;
        }
        default:
            break; // indexes and unknown records
        }
    }

    /// Adds a schema or a channel. The first record with an id counts.
    void define(const RecordView& record) {
        const auto add = [&](auto& known, auto definition) {
            const auto found = known.find(definition.id);
            if (found != known.end()) {
                if (!(found->second == definition))
                    problem("has different {} records with the id {}: the first one is used",
                            record_name(record.op), definition.id);
                return;
            }
            definitions_ += record.content.size();
            if (definitions_ > max_definitions)
                throw Error("exceeds the limit of 256 MiB of schemas and channels");
            known.emplace(definition.id, std::move(definition));
        };
        if (record.op == OpCode::schema)
            add(contents_.schemas, parsed<Schema>(record.content));
        else
            add(contents_.channels, parsed<Channel>(record.content));
    }

    void count(const Message& message, std::size_t block) {
        ++counts_[message.channel_id];
        times_.add(message.log_time);
        contents_.blocks_of_channel.try_emplace(message.channel_id, block, block).first->second.second =
            block;
    }

    void add_message(const RecordPlace& record) {
        const auto front = std::min<std::uint64_t>(record.length, message_head_size);
        const auto message = parsed<Message>(file_.read(record.content(), front));
        const std::uint64_t size = record_head_size + record.length;
        auto& blocks = contents_.blocks;
        const bool follows = !blocks.empty() && !blocks.back().chunk &&
                             blocks.back().length + size <= max_run &&
                             blocks.back().offset + blocks.back().length == record.offset;
        if (!follows) {
            blocks.push_back({record.offset, 0, false, false, message.log_time, message.log_time, 0, ""});
        }
        Block& run = blocks.back();
        run.length += size;
        run.uncompressed_size = run.length;
        run.start_time = std::min(run.start_time, message.log_time);
        run.end_time = std::max(run.end_time, message.log_time);
        count(message, blocks.size() - 1);
    }

    /// Returns the number of messages in the chunk.
    std::uint64_t add_chunk(const RecordPlace& record, bool is_cut = false) {
        Block block{record.offset, record_head_size + record.length, true, is_cut, 0, 0, 0, ""};
        if (is_cut) block.length = file_.size() - record.offset;
        ChunkHead head;
        load(file_, block, records_, &head);
        block.compression = head.compression;
        block.uncompressed_size = records_.size();
        TimeRange times;
        std::uint64_t messages = 0;
        RecordSequence sequence(records_);
        while (const auto inner = sequence.next()) {
            try {
                if (inner->op == OpCode::schema || inner->op == OpCode::channel) define(*inner);
                if (inner->op != OpCode::message) continue;
                const auto message = parsed<Message>(inner->content);
                times.add(message.log_time);
                count(message, contents_.blocks.size());
                ++messages;
            } catch (const Error& error) {
                problem("the {} at byte {} of the Chunk at byte {} {}: it is skipped", record_name(inner->op),
                        inner->offset, record.offset, error.what());
            }
        }
        if (sequence.torn() && !is_cut) problem("the Chunk at byte {} ends within a record", record.offset);
        block.start_time = times.start();
        block.end_time = times.end();
        contents_.blocks.push_back(block);
        ++chunks_;
        return messages;
    }

    /// Reports that the file ends within this record.
    void cut(const RecordPlace& record) {
        std::string rest;
        if (record.op == OpCode::chunk) {
            try {
                const auto front = std::min<std::uint64_t>(file_.size() - record.content(), chunk_head_limit);
                const auto head = parsed<ChunkHead>(file_.read(record.content(), front));
                rest = head.compression.empty()
                           ? fmt::format(", of which {} messages are readable", add_chunk(record, true))
                           : ", whose " + head.compression + " data are lost";
            } catch (const Error&) {
                rest = ", which is unreadable";
            }
        }
        problem("is truncated at byte {}, in the {} at byte {}{}", file_.size(), record_name(record.op),
                record.offset, rest);
    }

    bool finish(bool ended) {
        Statistics& statistics = contents_.statistics;
        statistics.schema_count = static_cast<std::uint16_t>(contents_.schemas.size());
        statistics.channel_count = static_cast<std::uint32_t>(contents_.channels.size());
        statistics.attachment_count = static_cast<std::uint32_t>(contents_.attachments.size());
        statistics.metadata_count = static_cast<std::uint32_t>(contents_.metadata.size());
        statistics.chunk_count = chunks_;
        statistics.start_time = times_.start();
        statistics.end_time = times_.end();
        for (const auto& [channel, count] : counts_) {
            statistics.channel_message_counts.emplace_back(channel, count);
            statistics.message_count += count;
        }
        return ended;
    }

    File& file_;
    Contents& contents_;
    Bytes records_; // of one chunk
    std::map<std::uint16_t, std::uint64_t> counts_;
    TimeRange times_;
    std::uint64_t definitions_ = 0;
    std::uint32_t chunks_ = 0;
};

/// Reads the data section from `begin` to its end, or to the place where the file is truncated or damaged, into
/// `contents`. Returns whether the end of the data (DataEnd or footer) was found. Adds a line to `contents.problems`
/// for each unreadable part.
bool scan(File& file, std::uint64_t begin, Contents& contents) { return Scan(file, contents).run(begin); }

constexpr std::uint64_t max_attachment_fields = std::uint64_t{64} * 1024;

} // namespace

Header read_header(File& file, std::uint64_t& end) {
    const auto not_mcap = [&](const char* why) {
        return file.error(std::string("is not an MCAP file: ") + why);
    };
    if (file.size() == 0) throw not_mcap("it is empty");
    if (file.size() < sizeof(magic) ||
        std::memcmp(file.read(0, sizeof(magic)).data(), magic, sizeof(magic)) != 0)
        throw not_mcap("it does not begin with \\x89MCAP0\\r\\n");
    const auto record = file.record_at(sizeof(magic));
    if (!record || record->op != OpCode::header || !file.holds(*record))
        throw not_mcap("its first record is not a complete Header");
    end = record->content() + record->length;
    try {
        return parsed<Header>(file.content_of(*record));
    } catch (const Error& error) {
        throw not_mcap((std::string("its Header ") + error.what()).c_str());
    }
}

Contents read_contents(File& file) {
    Contents contents;
    std::uint64_t header_end = 0;
    contents.header = read_header(file, header_end);
    std::string fault;
    const Header header = contents.header;
    const SummaryState state = read_summary(file, contents, fault);
    if (state == SummaryState::sound) {
        contents.by_summary = true;
        return contents;
    }
    contents = {};
    contents.header = header;
    const bool ended = scan(file, header_end, contents);
    contents.complete = ended && state != SummaryState::no_end;
    if (state == SummaryState::damaged)
        add_problem(contents.problems,
                    file.error("the summary is damaged (" + fault + "): reading from the beginning").what());
    if (ended && state == SummaryState::no_end)
        add_problem(contents.problems,
                    file.error("is truncated after its data: messages and attachments are complete").what());
    return contents;
}

AttachmentPlace attachment_at(File& file, const RecordPlace& record) {
    AttachmentPlace place;
    FieldReader from(file.read(record.content(), std::min(record.length, max_attachment_fields)));
    const std::size_t read = from.rest().size();
    place.head.log_time = from.number<std::uint64_t>();
    place.head.create_time = from.number<std::uint64_t>();
    place.head.name = from.text();
    place.head.media_type = from.text();
    place.data_size = from.number<std::uint64_t>();
    const std::uint64_t before = read - from.rest().size();
    place.data_offset = record.content() + before;
    if (record.length - before < 4 || place.data_size > record.length - before - 4)
        throw Error("has data longer than the record");
    return place;
}

} // namespace tandem::mcap
