// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/file_descriptor.hpp"

#include <string>

namespace tandem::process {

/// A pipe from a child process to this one. Neither end is inherited by processes that other threads start.
class OutputPipe {
  public:
    OutputPipe(); ///< throws std::system_error

    int reader() const { return reader_.get(); } ///< for poll()
    int writer() const { return writer_.get(); } ///< for ChildOptions
    /// Call it once the child has started: only then does the pipe end when the child closes its end.
    void close_writer() { writer_ = FileDescriptor(); }
    /// Appends the data that can be read without waiting, at most 16 MiB. Returns false once no more data can come.
    bool read_available(std::string& text) const;

  private:
    FileDescriptor reader_, writer_;
};

} // namespace tandem::process
