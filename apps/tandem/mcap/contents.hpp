// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/read/block.hpp"

namespace tandem::mcap {

/// What a file contains, without its messages and the data of its attachments.
struct Contents {
    Header header;
    std::map<std::uint16_t, Schema> schemas;   ///< by id
    std::map<std::uint16_t, Channel> channels; ///< by id
    std::vector<Block> blocks;                 ///< in the order of the file
    /// The first and the last block that has messages of a channel; not known of files without message indexes.
    std::map<std::uint16_t, std::pair<std::size_t, std::size_t>> blocks_of_channel;
    std::vector<AttachmentIndex> attachments;
    std::vector<MetadataIndex> metadata;
    Statistics statistics;             ///< as the file says, or counted
    bool by_summary = false;           ///< false: the whole file was read
    bool complete = true;              ///< false: the recorder did not close the file, or its end is lost
    std::vector<std::string> problems; ///< a line each, with the name of the file
};

/// By the summary at the end of the file, if it is there, undamaged and lists everything; otherwise by reading from the
/// front what can be read. Throws Error for a file that is not MCAP or cannot be read.
Contents read_contents(File& file);

/// Throws Error if the file is not MCAP. `end` becomes the offset behind the header.
Header read_header(File& file, std::uint64_t& end);

/// Where an attachment's data lie in its record, and its fields before them.
struct AttachmentPlace {
    AttachmentHead head;
    std::uint64_t data_offset = 0, data_size = 0; ///< in the file
};
/// Throws Error, without the file's name, if the record is damaged.
AttachmentPlace attachment_at(File& file, const RecordPlace& record);

} // namespace tandem::mcap
