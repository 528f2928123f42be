// SPDX-License-Identifier: Apache-2.0
#ifndef COIL_TIMEMEASURE_H
#define COIL_TIMEMEASURE_H
#include <chrono>
#include <cmath>
#include <coil/TimeValue.h>
#include <cstddef>

namespace coil {

/// Statistics of the times between tick() and tack(), in seconds. Not synchronized.
class TimeMeasure {
  public:
    struct Statistics {
        double max_interval = 0, min_interval = 0, mean_interval = 0, std_deviation = 0;
    };
    explicit TimeMeasure(int /*buflen*/ = 100) {}
    void tick() { begin_ = std::chrono::steady_clock::now(); }
    /// Does nothing before the first tick().
    void tack() {
        if (begin_ == std::chrono::steady_clock::time_point()) return;
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin_;
        const double t = taken.count();
        interval_ = t;
        if (count_ == 0 || t < min_) min_ = t;
        if (count_ == 0 || t > max_) max_ = t;
        ++count_;
        sum_ += t;
        squares_ += t * t;
    }
    void reset() { *this = TimeMeasure(); }
    unsigned long count() const { return count_; }
    /// Returns the last measured time.
    TimeValue& interval() { return interval_; }
    bool getStatistics(double& max, double& min, double& mean, double& deviation) const {
        if (count_ == 0) return false;
        const double n = static_cast<double>(count_);
        max = max_;
        min = min_;
        mean = sum_ / n;
        deviation = std::sqrt(std::fmax(0.0, squares_ / n - mean * mean));
        return true;
    }
    Statistics getStatistics() const {
        Statistics s;
        getStatistics(s.max_interval, s.min_interval, s.mean_interval, s.std_deviation);
        return s;
    }

  private:
    std::chrono::steady_clock::time_point begin_{};
    unsigned long count_ = 0;
    TimeValue interval_;
    double min_ = 0, max_ = 0, sum_ = 0, squares_ = 0;
};

} // namespace coil
#endif
