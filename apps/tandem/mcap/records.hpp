// SPDX-License-Identifier: Apache-2.0
// The records of an MCAP file (specification: github.com/foxglove/mcap, website/docs/spec/index.md, "Records"). Times
// are nanoseconds since an epoch that the writer chooses. Offsets are bytes from the start of the file.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tandem::mcap {

using Bytes = std::vector<std::byte>;
using ByteView = std::span<const std::byte>;
using StringMap = std::map<std::string, std::string>;

/// A file cannot be read or written, or a call would make an invalid file. The message is one line.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// "Magic": the first and the last eight bytes of a file.
constexpr unsigned char magic[8] = {0x89, 'M', 'C', 'A', 'P', 0x30, '\r', '\n'};
/// Length of a record's op code (u8) and content length (u64).
constexpr std::size_t record_head_size = 9;

/// Values from 0x80 are private records; other missing values are reserved. Readers skip both.
enum class OpCode : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    attachment = 0x09,
    attachment_index = 0x0A,
    statistics = 0x0B,
    metadata = 0x0C,
    metadata_index = 0x0D,
    summary_offset = 0x0E,
    data_end = 0x0F,
};

struct Header {
    std::string profile, library;
};

struct Footer {
    std::uint64_t summary_start = 0, summary_offset_start = 0; ///< 0: none
    std::uint32_t summary_crc = 0;                             ///< 0: no CRC; the same for all other CRCs
};

struct Schema {
    std::uint16_t id = 0; ///< not 0
    std::string name, encoding;
    Bytes data;
    bool operator==(const Schema&) const = default;
};

struct Channel {
    std::uint16_t id = 0, schema_id = 0; ///< schema_id 0: none
    std::string topic, message_encoding;
    StringMap metadata;
    bool operator==(const Channel&) const = default;
};

struct Message {
    std::uint16_t channel_id = 0;
    std::uint32_t sequence = 0;
    std::uint64_t log_time = 0, publish_time = 0;
    ByteView data; ///< points into a buffer of the function that returned the message
};
/// Length of a message's fields before its data.
constexpr std::size_t message_head_size = 2 + 4 + 8 + 8;

/// A chunk without its records.
struct ChunkHead {
    std::uint64_t start_time = 0, end_time = 0; ///< range of the messages' log times; 0 without messages
    std::uint64_t uncompressed_size = 0;
    std::uint32_t uncompressed_crc = 0;
    std::string compression = {};
    std::uint64_t stored_size = 0; ///< of the records in the file
};

struct MessageIndex {
    std::uint16_t channel_id = 0;
    std::vector<std::pair<std::uint64_t, std::uint64_t>>
        entries; ///< log time, offset in the uncompressed records
};

struct ChunkIndex {
    std::uint64_t start_time = 0, end_time = 0;
    std::uint64_t chunk_offset = 0, chunk_length = 0;                           ///< of the whole record
    std::vector<std::pair<std::uint16_t, std::uint64_t>> message_index_offsets; ///< by channel
    std::uint64_t message_index_length = 0;
    std::string compression;
    std::uint64_t stored_size = 0, uncompressed_size = 0;
};

/// An attachment without its data.
struct AttachmentHead {
    std::uint64_t log_time = 0, create_time = 0; ///< create_time 0: unknown
    std::string name, media_type;
};

struct AttachmentIndex {
    std::uint64_t offset = 0, length = 0; ///< of the whole record
    AttachmentHead attachment;
    std::uint64_t data_size = 0;
};

struct Metadata {
    std::string name;
    StringMap metadata;
};

struct MetadataIndex {
    std::uint64_t offset = 0, length = 0; ///< of the whole record
    std::string name;
};

struct Statistics {
    std::uint64_t message_count = 0;
    std::uint16_t schema_count = 0;
    std::uint32_t channel_count = 0, attachment_count = 0, metadata_count = 0, chunk_count = 0;
    std::uint64_t start_time = 0, end_time = 0; ///< range of all messages' log times; 0 without messages
    std::vector<std::pair<std::uint16_t, std::uint64_t>>
        channel_message_counts; ///< of channels with messages
};

struct SummaryOffset {
    OpCode group = OpCode{};
    std::uint64_t start = 0, length = 0;
};

struct DataEnd {
    std::uint32_t data_section_crc = 0;
};

} // namespace tandem::mcap
