// SPDX-License-Identifier: Apache-2.0
// The fields of each record in the order of the file, for writing (const) and reading (specification: "Records").
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <concepts>
#include <tuple>
#include <type_traits>

namespace tandem::mcap {

template <typename T, typename Record>
concept Is = std::same_as<std::remove_const_t<T>, Record>;

auto fields_of(Is<Header> auto& r) { return std::tie(r.profile, r.library); }
auto fields_of(Is<Footer> auto& r) {
    return std::tie(r.summary_start, r.summary_offset_start, r.summary_crc);
}
auto fields_of(Is<Schema> auto& r) { return std::tie(r.id, r.name, r.encoding, r.data); }
auto fields_of(Is<Channel> auto& r) {
    return std::tie(r.id, r.schema_id, r.topic, r.message_encoding, r.metadata);
}
/// The data of the message follow these fields.
auto fields_of(Is<Message> auto& r) { return std::tie(r.channel_id, r.sequence, r.log_time, r.publish_time); }
/// The records of the chunk follow these fields.
auto fields_of(Is<ChunkHead> auto& r) {
    return std::tie(r.start_time, r.end_time, r.uncompressed_size, r.uncompressed_crc, r.compression,
                    r.stored_size);
}
auto fields_of(Is<MessageIndex> auto& r) { return std::tie(r.channel_id, r.entries); }
auto fields_of(Is<ChunkIndex> auto& r) {
    return std::tie(r.start_time, r.end_time, r.chunk_offset, r.chunk_length, r.message_index_offsets,
                    r.message_index_length, r.compression, r.stored_size, r.uncompressed_size);
}
auto fields_of(Is<AttachmentHead> auto& r) {
    return std::tie(r.log_time, r.create_time, r.name, r.media_type);
}
auto fields_of(Is<AttachmentIndex> auto& r) {
    return std::tie(r.offset, r.length, r.attachment.log_time, r.attachment.create_time, r.data_size,
                    r.attachment.name, r.attachment.media_type);
}
auto fields_of(Is<Metadata> auto& r) { return std::tie(r.name, r.metadata); }
auto fields_of(Is<MetadataIndex> auto& r) { return std::tie(r.offset, r.length, r.name); }
auto fields_of(Is<Statistics> auto& r) {
    return std::tie(r.message_count, r.schema_count, r.channel_count, r.attachment_count, r.metadata_count,
                    r.chunk_count, r.start_time, r.end_time, r.channel_message_counts);
}
auto fields_of(Is<SummaryOffset> auto& r) { return std::tie(r.group, r.start, r.length); }
auto fields_of(Is<DataEnd> auto& r) { return std::tie(r.data_section_crc); }

} // namespace tandem::mcap
