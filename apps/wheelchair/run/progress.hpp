// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::wheelchair {

/// Shows on standard error how far a run is: on a terminal one line that is rewritten in place, elsewhere a
/// new line every ten seconds. For one thread.
class Progress {
  public:
    explicit Progress(std::string what); // `what` names the run
    ~Progress();                         // clears the line
    /// Shows `seconds` of `of` seconds, if it is time for that.
    void show(double seconds, double of);
    /// Prints a line that stays; removes the progress line from the terminal before.
    void print_line(const std::string& line);

  private:
    void erase_line();

    std::string what_;
    bool terminal_, visible_ = false;
    double next_ = 0.0; // CLOCK_MONOTONIC [s] of the next time that show() prints
};

} // namespace tandem::wheelchair
