// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace tandem::command {

/// Writes the log of a program to standard output or standard error. The program continues if writing fails, for
/// example on a full disk. Counts lost lines and reports their number when writing works again. [one thread]
class LogOutput {
  public:
    /// `program`: prefix of the report about lost lines. The caller disables termination by SIGPIPE and SIGXFSZ.
    LogOutput(int descriptor, std::string program) : descriptor_(descriptor), program_(std::move(program)) {}

    /// Writes whole lines; with none, tries to report lost lines. Waits at most one second for the reader, and not at
    /// all while the reader is stalled. Returns false if the reader is gone.
    bool write(std::string_view lines);

    std::uint64_t missing() const { return missing_; } ///< lost lines that are not reported yet
    /// Returns "N lines of the log could not be written (CAUSE)".
    std::string notice() const;

  private:
    std::size_t write_some(std::string_view text);

    const int descriptor_;
    const std::string program_;
    std::uint64_t missing_ = 0;
    int error_ = 0;         ///< errno value of the loss; EAGAIN: the reader is stalled
    bool mid_line_ = false; ///< the last write ended within a line
    std::chrono::milliseconds patience_{1000};
};

} // namespace tandem::command
