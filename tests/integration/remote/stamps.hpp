// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

/// Counts messages {number, CLOCK_MONOTONIC at sending [s], number of the last one}, and reports how long
/// they took.
class Stamps {
  public:
    static double now() {
        timespec time{};
        clock_gettime(CLOCK_MONOTONIC, &time); // the same for all processes of the machine
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }
    /// True for the last one.
    bool take(double number, double sent, double last) {
        microseconds_.push_back(1e6 * (now() - sent));
        in_order_ = in_order_ && number > before_;
        before_ = number;
        return number == last;
    }
    /// `1000 messages in order, p50 12.3 us, p99 45.6 us`
    std::string text() const {
        if (microseconds_.empty()) return "0 messages";
        std::vector<double> sorted(microseconds_);
        std::sort(sorted.begin(), sorted.end());
        char text[100];
        std::snprintf(text, sizeof text, "%zu messages %s, p50 %.1f us, p99 %.1f us", sorted.size(),
                      in_order_ ? "in order" : "out of order", sorted[sorted.size() / 2],
                      sorted[sorted.size() * 99 / 100]);
        return text;
    }

  private:
    std::vector<double> microseconds_;
    double before_ = 0;
    bool in_order_ = true;
};
