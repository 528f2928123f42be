// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/contents.hpp"

#include "apps/tandem/mcap/format/decode.hpp"
#include "apps/tandem/mcap/read/problems.hpp"
#include "apps/tandem/mcap/read/scan.hpp"
#include "apps/tandem/mcap/read/summary.hpp"

#include <algorithm>
#include <cstring>

namespace tandem::mcap {
namespace {

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
