// SPDX-License-Identifier: Apache-2.0
// Small mathematical functions of device components. The end of a name gives the unit of angles.
#ifndef DEVICE_OPROSMATH_H_
#define DEVICE_OPROSMATH_H_

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <math.h>
#include <stdlib.h>
#include <valarray>

#ifndef M_SQRTPI
#define M_SQRTPI 1.77245385090551602729
#endif
#ifndef M_SQRT3
#define M_SQRT3 1.73205080756887729352
#endif
#ifndef M_LNPI
#define M_LNPI 1.14472988584940017414
#endif
#ifndef M_EULER
#define M_EULER 0.57721566490153286061
#endif
#define _RAD2DEG (180. / M_PI)
#define _DEG2RAD (M_PI / 180.)

using std::max; // components rely on it
using std::min;

const double NaN = std::numeric_limits<double>::quiet_NaN();

inline double RAD2DEG(double x) { return x * _RAD2DEG; }
inline double DEG2RAD(double x) { return x * _DEG2RAD; }

template <typename T>
inline T min_val(T v1, T v2) {
    return v1 < v2 ? v1 : v2;
}
template <typename T>
inline T max_val(T v1, T v2) {
    return v1 > v2 ? v1 : v2;
}
/// Limits x to the range.
inline double Limit(double x, double lo, double hi) { return x < lo ? lo : (x > hi ? hi : x); }
template <typename T>
inline T bound(T x, T l, T u) {
    return x <= l ? l : (x >= u ? u : x);
}
template <typename T>
inline void Swap(T& v1, T& v2) {
    const T first = v1;
    v1 = v2;
    v2 = first;
}

/// Rotates the first two coordinates about the third axis. Does not change result[2].
inline void Rotate(double result[3], const double src[3], double rad) {
    const double x = src[0] * std::cos(rad) - src[1] * std::sin(rad);
    const double y = src[0] * std::sin(rad) + src[1] * std::cos(rad);
    result[0] = x;
    result[1] = y;
}

/// Returns a normally distributed number (Box and Muller), from rand().
inline double GaussRand() {
    const double u = (std::rand() + 1.) / (RAND_MAX + 2.);
    const double v = std::rand() / (RAND_MAX + 1.);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
}

/// Rounds half away from zero.
inline int INTEGER(const double a) { return static_cast<int>(a + (0 < a ? 0.5 : -0.5)); }
inline double Sign(const double v) { return 0 < v ? 1. : -1.; }

/// Return ang1 - ang2, normalized to half a turn to either side.
inline double DeltaDeg(double ang1, double ang2) {
    const double difference = std::fmod(ang1 - ang2, 360);
    if (180 <= difference) return difference - 360;
    return difference <= -180 ? difference + 360 : difference;
}
inline int DeltaDeg(int ang1, int ang2) {
    const int difference = (ang1 - ang2) % 360;
    if (180 <= difference) return difference - 360;
    return difference <= -180 ? difference + 360 : difference;
}
inline double DeltaRad(double ang1, double ang2) {
    const double difference = std::fmod(ang1 - ang2, 2 * M_PI);
    if (M_PI <= difference) return difference - 2 * M_PI;
    return difference <= -M_PI ? difference + 2 * M_PI : difference;
}

inline double Length(double x, double y) { return std::sqrt(x * x + y * y); }
inline double Distance(double x1, double y1, double x2, double y2) { return Length(x2 - x1, y2 - y1); }
inline int Distance(int x1, int y1, int x2, int y2) {
    return INTEGER(Length(static_cast<double>(x2 - x1), static_cast<double>(y2 - y1)));
}

inline bool IsNum(double num) { return !std::isnan(num); }
/// Returns the number of values that are not NaN.
inline int CountNum(std::valarray<double>& v) {
    int count = 0;
    for (std::size_t i = 0; i < v.size(); ++i) count += IsNum(v[i]) ? 1 : 0;
    return count;
}
/// Replaces NaN by 0, also in the argument.
inline std::valarray<double> FilterNaN(std::valarray<double>& v) {
    for (std::size_t i = 0; i < v.size(); ++i)
        if (!IsNum(v[i])) v[i] = 0.;
    return v;
}

#endif
