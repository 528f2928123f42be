// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/message_cursor.hpp"

namespace tandem::mcap {

/// Reads an MCAP file of any writer by its summary. Reads a file without a summary, or a truncated or damaged file,
/// from the front as far as possible. Does not trust sizes in the file: allocates memory only for existing data, and at
/// most 1 GiB for a chunk. [one thread at a time]
class McapReader {
  public:
    /// Throws Error with one line that contains the file's name, if the file is not MCAP or cannot be read.
    explicit McapReader(const std::filesystem::path& file) : file_(file), contents_(read_contents(file_)) {}

    const Contents& contents() const { return contents_; }
    std::uint64_t file_size() const { return file_.size(); }
    /// The reader must outlive the cursor.
    MessageCursor messages(Query query = {}) { return {file_, contents_, std::move(query)}; }
    /// Returns the data of an entry in `contents().attachments`. Throws Error, for example if the CRC-32 does not match.
    Bytes attachment_data(const AttachmentIndex& index);
    /// Returns an entry of `contents().metadata`. Throws Error.
    Metadata metadata(const MetadataIndex& index);
    File& file() { return file_; }

  private:
    RecordPlace place_of_record(std::uint64_t offset, OpCode op);

    File file_;
    Contents contents_;
};

} // namespace tandem::mcap
