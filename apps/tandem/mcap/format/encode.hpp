// SPDX-License-Identifier: Apache-2.0
// Records as bytes (specification: "Serialization": little-endian; strings, arrays and maps behind a u32 of bytes).
// Each function appends a whole record, op code and length included. They throw Error for a string that is not UTF-8
// or has 4 GiB or more.
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <array>

namespace tandem::mcap {

void append(Bytes& out, const Header& header);
void append(Bytes& out, const Schema& schema);
void append(Bytes& out, const Channel& channel);
void append(Bytes& out, const Message& message);
void append(Bytes& out, const MessageIndex& index);
void append(Bytes& out, const ChunkIndex& index);
void append(Bytes& out, const AttachmentIndex& index);
void append(Bytes& out, const Metadata& metadata);
void append(Bytes& out, const MetadataIndex& index);
void append(Bytes& out, const Statistics& statistics);
void append(Bytes& out, const SummaryOffset& offset);
void append(Bytes& out, const DataEnd& end);
/// The CRC is that of the summary before the footer; the record gets it continued over its own first fields.
void append(Bytes& out, Footer footer);

/// What comes before a chunk's records, which end the record.
void append_head(Bytes& out, const ChunkHead& chunk);
/// What comes before an attachment's data, which its CRC follows: that of the head without its first
/// `record_head_size` bytes and of the data.
void append_head(Bytes& out, const AttachmentHead& attachment, std::uint64_t data_size);

/// A number as it stands in a file.
template <typename Number>
std::array<std::byte, sizeof(Number)> little_endian(Number value) {
    std::array<std::byte, sizeof(Number)> bytes;
    for (std::size_t i = 0; i < sizeof(Number); ++i) bytes[i] = static_cast<std::byte>(value >> (8 * i));
    return bytes;
}

} // namespace tandem::mcap
