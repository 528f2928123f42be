// SPDX-License-Identifier: Apache-2.0
// Name of OpenRTM-aist 1.x.
#ifndef COIL_TIMEVALUE_H
#define COIL_TIMEVALUE_H
#include <cmath>

namespace coil {

/// Seconds and microseconds of one sign.
class TimeValue {
public:
    TimeValue(long sec = -1, long usec = 0) : sec_(sec), usec_(usec) { normalize(); }
    explicit TimeValue(double seconds) { *this = seconds; }

    TimeValue& operator=(double seconds) {
        sec_ = static_cast<long>(seconds);
        usec_ = std::lround((seconds - static_cast<double>(sec_)) * 1e6);
        normalize();
        return *this;
    }
    TimeValue operator+(const TimeValue& other) const { return TimeValue(sec_ + other.sec_, usec_ + other.usec_); }
    TimeValue operator-(const TimeValue& other) const { return TimeValue(sec_ - other.sec_, usec_ - other.usec_); }
    long sec() const { return sec_; }
    long usec() const { return usec_; }
    double toDouble() const { return static_cast<double>(sec_) + static_cast<double>(usec_) / 1e6; }
    operator double() const { return toDouble(); }
    int sign() const { return toDouble() > 0 ? 1 : toDouble() < 0 ? -1 : 0; }
    void normalize() {
        sec_ += usec_ / 1000000;
        usec_ %= 1000000;
        if (sec_ > 0 && usec_ < 0) {
            --sec_;
            usec_ += 1000000;
        } else if (sec_ < 0 && usec_ > 0) {
            ++sec_;
            usec_ -= 1000000;
        }
    }

private:
    long sec_ = 0;
    long usec_ = 0;
};

} // namespace coil
#endif
