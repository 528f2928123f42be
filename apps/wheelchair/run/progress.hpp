// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tandem::wheelchair {

/// One line on stderr while a run lasts: rewritten in place on a terminal, every ten seconds anew elsewhere.
class Progress {
  public:
    explicit Progress(std::string what);
    ~Progress(); // wipes the line
    void show(double seconds, double of);
    /// A line that stays, not torn by the progress line.
    void print_line(const std::string& line);

  private:
    void clear();

    std::string what_;
    bool terminal_, visible_ = false;
    double next_ = 0.0; // CLOCK_MONOTONIC [s]
};

} // namespace tandem::wheelchair
