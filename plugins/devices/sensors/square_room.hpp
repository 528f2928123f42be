// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace tandem::devices {

/// Returns the distance from the middle of a square room with sides of 4 m to its wall; m, rad.
inline double distance_in_square_room(double angle) {
    // Uses the nearer of the two walls that the beam's line crosses, each 2 m from the middle.
    return 2 / std::max(std::fabs(std::cos(angle)), std::fabs(std::sin(angle)));
}

} // namespace tandem::devices
