// SPDX-License-Identifier: Apache-2.0
// The destination of a writer's bytes.
#pragma once
#include "apps/tandem/mcap/disk_sync.hpp"
#include "apps/tandem/mcap/new_file.hpp"
#include "apps/tandem/mcap/records.hpp"

#include <filesystem>
#include <optional>

namespace tandem::mcap {

class Sink {
  public:
    Sink() = default;
    Sink(const Sink&) = delete;
    Sink& operator=(const Sink&) = delete;
    virtual ~Sink() = default;
    /// Appends the bytes. Throws Error if they cannot be written.
    virtual void write(ByteView bytes) = 0;
    /// Ensures that the bytes written so far survive the death of the process. Throws Error.
    virtual void flush() = 0;
    /// Ensures that the next `size` bytes find room. Throws Error if it is known that they do not.
    virtual void reserve(std::uint64_t) {}
    /// Drops everything after the first `size` bytes, and forgets an error. Returns false if that is impossible.
    virtual bool truncate(std::uint64_t) { return false; }
};

/// A new buffered file. What was flushed also goes to the disk, at most once a second and without a wait. Errors are
/// one line with the file and the cause. After an error, each call throws it again, so that no bytes follow a gap.
/// [one thread at a time]
class FileSink : public Sink {
  public:
    /// Creates the file. Throws Error if it exists and is not empty, because it may be a recording.
    explicit FileSink(const std::filesystem::path& file, NewFile::Named named = NewFile::Named::at_once);
    ~FileSink() override = default; ///< Writes nothing. Bytes that were not flushed are lost.
    void write(ByteView bytes) override;
    void flush() override;
    /// Considers the file system and the limit of the process (`ulimit -f`).
    void reserve(std::uint64_t size) override;
    bool truncate(std::uint64_t size) override;
    /// Flushes the file, waits until it is on the disk, and closes it. Throws Error, including for errors that the file
    /// system reports only then.
    void close();
    /// Removes the file.
    void discard();

  private:
    void write_out(ByteView bytes);
    [[noreturn]] void fail(int error);

    NewFile file_;
    std::optional<DiskSync> disk_; ///< of a regular file
    std::uint64_t size_ = 0;       ///< without the buffer
    Bytes buffer_;
    std::string failure_;
};

} // namespace tandem::mcap
