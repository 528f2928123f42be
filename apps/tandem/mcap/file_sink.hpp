// SPDX-License-Identifier: Apache-2.0
// The destination of a writer's bytes.
#pragma once
#include "apps/tandem/mcap/records.hpp"
#include "host/process/file_descriptor.hpp"

#include <filesystem>

namespace tandem::mcap {

class Sink {
  public:
    Sink() = default;
    Sink(const Sink&) = delete;
    Sink& operator=(const Sink&) = delete;
    virtual ~Sink() = default;
    /// Appends the bytes. Throws Error if they cannot be written.
    virtual void write(ByteView bytes) = 0;
    /// Ensures that a death of the process does not lose the bytes written so far. Throws Error.
    virtual void flush() = 0;
};

/// A new buffered file. Errors are one line with the file and the cause. After an error, each call throws it again, so
/// that no bytes follow a gap. [one thread at a time]
class FileSink : public Sink {
  public:
    /// Creates the file. Throws if it exists and is not empty, because it may be a recording. The destructor writes
    /// nothing: bytes that were not flushed are lost.
    explicit FileSink(std::filesystem::path file);
    void write(ByteView bytes) override;
    void flush() override;
    /// Flushes and closes the file. Also throws Error for errors that the file system reports on closing.
    void close();

  private:
    void write_out(ByteView bytes);
    [[noreturn]] void fail(int error);

    std::filesystem::path file_;
    process::FileDescriptor descriptor_;
    Bytes buffer_;
    std::string failure_;
};

} // namespace tandem::mcap
