// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <filesystem>
#include <optional>

namespace tandem::mcap {

/// Where a record lies in a file. Its content may end beyond the file's end: then the file is cut.
struct RecordPlace {
    OpCode op = OpCode{};
    std::uint64_t offset = 0; ///< of its op code
    std::uint64_t length = 0; ///< of its content, as the file claims
    std::uint64_t content() const { return offset + record_head_size; }
};

/// A file that is read at any place. Its size is the one that it had when it was opened. Used by one thread at a time.
class File {
  public:
    /// Throws Error that names the file.
    explicit File(std::filesystem::path path);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t size() const { return size_; }
    /// `size` bytes from the offset on, valid until the next call. Throws Error beyond the end, and before it takes
    /// memory for more than is there, or for 1 GiB and more.
    ByteView read(std::uint64_t offset, std::uint64_t size);
    /// The record that begins at the offset; none if the file ends before its content begins.
    std::optional<RecordPlace> record_at(std::uint64_t offset);
    /// Whether the record's content is in the file, all of it.
    bool holds(const RecordPlace& record) const { return record.length <= size_ - record.content(); }
    /// Its content. Throws as read().
    ByteView content_of(const RecordPlace& record) { return read(record.content(), record.length); }
    /// "FILE: WHAT".
    Error error(const std::string& what) const { return Error(path_.string() + ": " + what); }

  private:
    std::filesystem::path path_;
    int descriptor_;
    std::uint64_t size_ = 0;
    Bytes window_; // the bytes from window_offset_ on
    std::uint64_t window_offset_ = 0;
};

} // namespace tandem::mcap
