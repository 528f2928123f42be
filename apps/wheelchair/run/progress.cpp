// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "apps/tandem/output/print_note.hpp"
#include "plugins/wheelchair/core/body/clock.hpp"

namespace tandem::wheelchair {

Progress::Progress(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO)) {
    // A shorter run shows no progress.
    next_ = monotonic_seconds() + (terminal_ ? 0.5 : 10.0);
}

Progress::~Progress() { erase_line(); }

// Writes \r and the escape sequence that erases to the end of the line.
void Progress::erase_line() {
    if (visible_) command::print_note("\r\033[K");
    visible_ = false;
    std::fflush(stderr);
}

void Progress::show(double seconds, double of) {
    if (monotonic_seconds() < next_) return;
    command::print_note("{}wheelchair: {}, {:.1f} of {:.1f} s{}", terminal_ ? "\r\033[K" : "", what_, seconds,
                        of, terminal_ ? "" : "\n");
    std::fflush(stderr);
    visible_ = terminal_;
    next_ = monotonic_seconds() + (terminal_ ? 0.2 : 10.0);
}

void Progress::print_line(const std::string& line) {
    erase_line();
    command::print_note("wheelchair: {}\n", line);
    std::fflush(stderr);
}

} // namespace tandem::wheelchair
