// SPDX-License-Identifier: Apache-2.0
// Encodes records (specification: "Serialization": little-endian; strings, arrays and maps after a u32 length in
// bytes). Each function appends a complete record with op code and length. They throw Error for a string that is not
// UTF-8 or has 4 GiB or more.
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
/// `footer.summary_crc`: CRC of the summary before the footer. The function extends it over the footer's first fields.
void append(Bytes& out, Footer footer);

/// Appends a chunk's fields before its records. The caller appends the records.
void append_head(Bytes& out, const ChunkHead& chunk);
/// Appends an attachment's fields before its data. The caller appends the data and the CRC of these fields and the
/// data, without the first `record_head_size` bytes.
void append_head(Bytes& out, const AttachmentHead& attachment, std::uint64_t data_size);

/// Returns a number's bytes in a file.
template <typename Number>
std::array<std::byte, sizeof(Number)> little_endian(Number value) {
    std::array<std::byte, sizeof(Number)> bytes;
    for (std::size_t i = 0; i < sizeof(Number); ++i) bytes[i] = static_cast<std::byte>(value >> (8 * i));
    return bytes;
}

} // namespace tandem::mcap
