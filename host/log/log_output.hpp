// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/os/close_on_fork_descriptor.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace tandem::log {

/// Writes the log of a program to standard output or standard error. The program continues if writing fails, for
/// example on a full disk or without a reader. Counts lost lines and reports their number when writing works again. [one thread]
class LogOutput {
  public:
    /// `program`: prefix of the report about lost lines. `patience`: how long a write waits for a reader that does not
    /// keep up. The caller disables termination by SIGPIPE and SIGXFSZ.
    LogOutput(int descriptor, std::string program,
              std::chrono::milliseconds patience = std::chrono::milliseconds(1000));
    ~LogOutput(); ///< Tries to report lost lines.
    LogOutput(const LogOutput&) = delete;
    LogOutput& operator=(const LogOutput&) = delete;

    /// Writes whole lines; with none, tries to report lost lines. Waits at most `patience` for the reader, and not at
    /// all while the reader is stalled. Returns false if the reader is gone; another one may come, as at a FIFO.
    bool write(std::string_view lines);

    std::uint64_t missing() const { return missing_; } ///< lost lines that are not reported yet
    /// Returns "N lines of the log could not be written (CAUSE)".
    std::string notice() const;

  private:
    std::size_t write_some(std::string_view text);

    const int descriptor_;
    /// A separate open file of the same pipe or terminal, whose writes never block; may be null. A helper process that a
    /// component forks must not keep the pipe of the log open.
    const std::unique_ptr<shm::CloseOnForkDescriptor> nonblocking_;
    const std::string program_;
    const std::chrono::milliseconds patience_;
    std::uint64_t missing_ = 0;
    int error_ = 0;         ///< errno value of the loss; EAGAIN: the reader is stalled, EPIPE: gone
    bool mid_line_ = false; ///< the last write ended within a line
    bool stalled_ = false;  ///< the last write failed
};

} // namespace tandem::log
