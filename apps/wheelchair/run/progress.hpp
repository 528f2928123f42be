// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::wheelchair {

/// Shows a run's progress on standard error: on a terminal in one line that is rewritten, otherwise as a new line every
/// ten seconds. [one thread]
class Progress {
  public:
    explicit Progress(std::string what); // `what` names the run
    ~Progress();                         // clears the line
    /// Shows that `seconds` of `of` seconds are done, if an update is due.
    void show(double seconds, double of);
    /// Prints a permanent line, after erasing the progress line from the terminal.
    void print_line(const std::string& line);

  private:
    void erase_line();

    std::string what_;
    bool terminal_, visible_ = false;
    double next_ = 0.0; // CLOCK_MONOTONIC [s] of the next update
};

} // namespace tandem::wheelchair
