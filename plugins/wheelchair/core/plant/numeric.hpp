// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace tandem::wheelchair {

/// Returns a smooth sign function, x / sqrt(x^2 + scale^2). Unlike tanh(), division and square root are exact in IEEE
/// arithmetic, so every compiler and C library gives the same bits.
inline double smooth_sign(double x, double scale) { return x / std::sqrt(x * x + scale * scale); }

/// Like std::clamp, but returns NaN for NaN, and low > high is defined.
inline double limit(double x, double low, double high) { return x < low ? low : (x > high ? high : x); }

} // namespace tandem::wheelchair
