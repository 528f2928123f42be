// SPDX-License-Identifier: Apache-2.0
// A name of OpenRTM-aist 1.x.
#ifndef COIL_TIMEVALUE_H
#define COIL_TIMEVALUE_H
#include <chrono>
#include <cmath>
#include <type_traits>

namespace coil {

/// A time span in seconds and microseconds with one sign. Converts to double (seconds): all arithmetic except + and -
/// of two TimeValues is that of double.
class TimeValue {
    template <class T>
    using IfInteger = typename std::enable_if<std::is_integral<T>::value, int>::type;
    template <class T>
    using IfFloating = typename std::enable_if<std::is_floating_point<T>::value, int>::type;
    // Templates accept no converted operands: `a - 0.5` stays a double and is not ambiguous.
    template <class T>
    using IfTime = typename std::enable_if<std::is_same<T, TimeValue>::value, int>::type;

  public:
    TimeValue() = default;
    TimeValue(long sec, long usec) : sec_(sec), usec_(usec) { normalize(); }
    template <class T, IfInteger<T> = 0>
    TimeValue(T seconds) : sec_(static_cast<long>(seconds)) {}
    template <class T, IfFloating<T> = 0>
    TimeValue(T seconds) {
        *this = static_cast<double>(seconds);
    }
    template <class Rep, class Period>
    explicit TimeValue(std::chrono::duration<Rep, Period> duration)
        : TimeValue(0, std::chrono::duration_cast<std::chrono::microseconds>(duration).count()) {}

    TimeValue& operator=(double seconds) {
        sec_ = static_cast<long>(seconds);
        usec_ = std::lround((seconds - static_cast<double>(sec_)) * 1e6);
        normalize();
        return *this;
    }
    template <class T, IfTime<T> = 0>
    TimeValue operator+(const T& other) const {
        return TimeValue(sec_ + other.sec_, usec_ + other.usec_);
    }
    template <class T, IfTime<T> = 0>
    TimeValue operator-(const T& other) const {
        return TimeValue(sec_ - other.sec_, usec_ - other.usec_);
    }
    long sec() const { return sec_; }
    long usec() const { return usec_; }
    double toDouble() const { return static_cast<double>(sec_) + static_cast<double>(usec_) / 1e6; }
    operator double() const { return toDouble(); }
    std::chrono::microseconds microseconds() const {
        return std::chrono::seconds(sec_) + std::chrono::microseconds(usec_);
    }
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
