// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace tandem::command {

/// Standard output or standard error as the log of a program that goes on whatever becomes of it. Lines that cannot be written, as on a
/// full disk or to a reader that does not read, are counted, and one line says how many once writing works again. [one thread]
class LogOutput {
  public:
    /// `program`: with which the line about the others begins. SIGPIPE and SIGXFSZ must not end the process.
    LogOutput(int descriptor, std::string program) : descriptor_(descriptor), program_(std::move(program)) {}

    /// Writes whole lines; without any, tries to write the line about those that are missing. Waits at most a second for a reader,
    /// and not at all for one that has not read since. Returns false once there is no reader any more.
    bool write(std::string_view lines);

    std::uint64_t missing() const { return missing_; } ///< Lines that nothing was said of yet.
    /// "N lines of the log could not be written (CAUSE)"
    std::string notice() const;

  private:
    std::size_t write_some(std::string_view text);

    const int descriptor_;
    const std::string program_;
    std::uint64_t missing_ = 0;
    int error_ = 0;         ///< why they are missing, an errno value; EAGAIN: nobody reads
    bool mid_line_ = false; ///< what was written last was part of a line
    std::chrono::milliseconds patience_{1000};
};

} // namespace tandem::command
