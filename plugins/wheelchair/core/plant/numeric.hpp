// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace tandem::wheelchair {

/// Smooth sign, x / sqrt(x^2 + s^2): exact in IEEE arithmetic, so every build agrees.
inline double smooth_sign(double x, double scale) { return x / std::sqrt(x * x + scale * scale); }

/// As std::clamp, but a NaN passes through unchanged and low > high is no undefined behaviour.
inline double limit(double x, double low, double high) { return x < low ? low : (x > high ? high : x); }

} // namespace tandem::wheelchair
