// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/mcap/reader.hpp"

#include "apps/tandem/mcap/format/crc32.hpp"

namespace tandem::mcap {

RecordPlace McapReader::place_of_record(std::uint64_t offset, OpCode op) {
    const auto place = file_.record_at(offset);
    if (place && place->op == op && file_.holds(*place)) return *place;
    throw file_.error("the " + record_name(op) + " at byte " + std::to_string(offset) + " is missing");
}

Bytes McapReader::attachment_data(const AttachmentIndex& index) {
    const RecordPlace place = place_of_record(index.offset, OpCode::attachment);
    const auto fail = [&](const std::string& what) {
        return file_.error("the Attachment at byte " + std::to_string(index.offset) + " " + what);
    };
    std::optional<AttachmentPlace> attachment;
    try {
        attachment = attachment_at(file_, place);
    } catch (const Error& error) {
        throw fail(error.what());
    }
    // The CRC covers all fields before it.
    const std::uint64_t before = attachment->data_offset - place.content();
    const ByteView content = file_.read(place.content(), before + attachment->data_size + 4);
    const ByteView fields = content.first(before + attachment->data_size);
    const auto crc = FieldReader(content.subspan(fields.size())).number<std::uint32_t>();
    if (crc != 0 && crc32(fields) != crc) throw fail("does not match its CRC-32");
    const ByteView data = fields.subspan(before);
    return {data.begin(), data.end()};
}

Metadata McapReader::metadata(const MetadataIndex& index) {
    const RecordPlace place = place_of_record(index.offset, OpCode::metadata);
    try {
        return parsed<Metadata>(file_.content_of(place));
    } catch (const Error& error) {
        throw file_.error("the Metadata at byte " + std::to_string(index.offset) + " " + error.what());
    }
}

} // namespace tandem::mcap
