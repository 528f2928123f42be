// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/records.hpp"

#include <filesystem>
#include <optional>

namespace tandem::mcap {

/// Position of a record in a file. If its content extends beyond the end, the file is truncated.
struct RecordPlace {
    OpCode op = OpCode{};
    std::uint64_t offset = 0; ///< of its op code
    std::uint64_t length = 0; ///< of its content, as claimed by the file
    std::uint64_t content() const { return offset + record_head_size; }
};

/// A file with random access. Its size is that at opening. [one thread at a time]
class File {
  public:
    /// Throws Error with the file's name.
    explicit File(std::filesystem::path path);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t size() const { return size_; }
    /// Returns `size` bytes at the offset. They are valid until the next call. Throws Error, before allocating memory,
    /// for bytes beyond the end or for more than 1 GiB.
    ByteView read(std::uint64_t offset, std::uint64_t size);
    /// Returns the record at the offset; nullopt if the file ends before its content.
    std::optional<RecordPlace> record_at(std::uint64_t offset);
    /// Returns whether the file contains the whole content of the record.
    bool holds(const RecordPlace& record) const { return record.length <= size_ - record.content(); }
    /// Returns the content of the record. Throws like read().
    ByteView content_of(const RecordPlace& record) { return read(record.content(), record.length); }
    /// Returns an Error with the text "FILE: WHAT".
    Error error(const std::string& what) const { return Error(path_.string() + ": " + what); }

  private:
    std::filesystem::path path_;
    int descriptor_;
    std::uint64_t size_ = 0;
    Bytes window_; // bytes from window_offset_
    std::uint64_t window_offset_ = 0;
};

} // namespace tandem::mcap
