// SPDX-License-Identifier: Apache-2.0
// Where a writer's bytes go.
#pragma once
#include "apps/tandem/mcap/records.hpp"

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
    /// From now on the death of the process loses nothing that has been written. Throws Error.
    virtual void flush() = 0;
};

/// A new file, buffered. An error is one line that names the file and the cause; after one, each call throws it again,
/// so that no later bytes follow a gap. Used by one thread at a time.
class FileSink : public Sink {
  public:
    /// Makes the file. Throws Error if there is one that is not empty, which may be a recording.
    explicit FileSink(std::filesystem::path file);
    ~FileSink() override; ///< Writes nothing: what has not been flushed is lost.
    void write(ByteView bytes) override;
    void flush() override;
    /// flush(), and errors that the file system reports when a file is closed.
    void close();

  private:
    void write_out(ByteView bytes);
    [[noreturn]] void fail(int error);

    std::filesystem::path file_;
    int descriptor_;
    Bytes buffer_;
    std::string failure_;
};

} // namespace tandem::mcap
