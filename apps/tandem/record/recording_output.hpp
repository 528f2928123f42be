// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/file_sink.hpp"
#include "apps/tandem/mcap/writer.hpp"

#include <string>

namespace tandem::command {

/// The file of a recording and its writer. [one thread]
class RecordingOutput {
  public:
    /// Creates the file, locked and with its name. Throws mcap::Error.
    RecordingOutput(const std::string& file, mcap::WriterOptions options);
    /// Closes the file if an exception ends the recording. Removes it if it has no message.
    ~RecordingOutput();

    const std::string& name() const { return name_; }
    mcap::McapWriter& writer() { return writer_; }
    /// Ends the file. Throws mcap::Error, see end_after().
    void close();
    /// Closes the file as far as possible after an error of the writer, and throws mcap::Error with one line that also
    /// says what is lost.
    [[noreturn]] void end_after(const mcap::Error& error);
    void discard(); ///< Removes the file.

  private:
    const std::string name_;
    mcap::FileSink file_;
    mcap::McapWriter writer_;
    bool ended_ = false;
};

} // namespace tandem::command
