// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/read/block.hpp"

namespace tandem::mcap {

/// The contents of a file, without its messages and the data of its attachments.
struct Contents {
    Header header;
    std::map<std::uint16_t, Schema> schemas;   ///< by id
    std::map<std::uint16_t, Channel> channels; ///< by id
    std::vector<Block> blocks;                 ///< in file order
    /// First and last block with messages of a channel; unknown if the file has no message indexes.
    std::map<std::uint16_t, std::pair<std::size_t, std::size_t>> blocks_of_channel;
    std::vector<AttachmentIndex> attachments;
    std::vector<MetadataIndex> metadata;
    Statistics statistics;             ///< from the file, or counted
    bool by_summary = false;           ///< false: the whole file was read
    bool complete = true;              ///< false: the recorder did not close the file, or its end is missing
    std::vector<std::string> problems; ///< one line each, with the name of the file
};

/// Reads the summary at the end of the file if it is present, undamaged and complete. Otherwise reads the file from the
/// front as far as possible. Throws Error if the file is not MCAP or cannot be read.
Contents read_contents(File& file);

/// Throws Error if the file is not MCAP. Sets `end` to the offset after the header.
Header read_header(File& file, std::uint64_t& end);

/// The fields of an attachment and the position of its data.
struct AttachmentPlace {
    AttachmentHead head;
    std::uint64_t data_offset = 0, data_size = 0; ///< offset in the file
};
/// Throws Error, without the file's name, if the record is damaged.
AttachmentPlace attachment_at(File& file, const RecordPlace& record);

} // namespace tandem::mcap
