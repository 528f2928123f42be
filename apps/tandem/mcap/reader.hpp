// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/message_cursor.hpp"

namespace tandem::mcap {

/// Reads an MCAP file of any writer. By its summary; a file without one, or that is cut (a killed recorder) or damaged,
/// from the front, as far as it goes. Sizes in the file are not trusted: memory is taken for what is there, and for
/// 1 GiB of one chunk at most. Used by one thread at a time.
class McapReader {
  public:
    /// Throws Error, one line with the file's name, if it is no MCAP file or cannot be read.
    explicit McapReader(const std::filesystem::path& file) : file_(file), contents_(read_contents(file_)) {}

    const Contents& contents() const { return contents_; }
    std::uint64_t file_size() const { return file_.size(); }
    /// The reader must outlive the cursor.
    MessageCursor messages(Query query = {}) { return {file_, contents_, std::move(query)}; }
    /// The data of one of `contents().attachments`. Throws Error, also for a CRC-32 that is not the data's.
    Bytes attachment_data(const AttachmentIndex& index);
    /// One of `contents().metadata`. Throws Error.
    Metadata metadata(const MetadataIndex& index);
    File& file() { return file_; }

  private:
    RecordPlace record(std::uint64_t offset, OpCode op);

    File file_;
    Contents contents_;
};

} // namespace tandem::mcap
