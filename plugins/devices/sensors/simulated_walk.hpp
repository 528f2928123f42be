// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

namespace tandem::devices {

/// Returns the data of a satellite receiver that moves on a circle of about 1 m at 37.29 N, 126.83 E; degrees, m/s.
/// `Data`: the type of OPRoS v1 or v1.1, which have the same members.
template <typename Data>
Data walk_on_circle(double seconds) {
    Data data;
    data.latitude = 37.29 + 1e-5 * std::sin(0.2 * M_PI * seconds); // 1e-5 degrees are 1.1 m
    data.longitude = 126.83 + 1e-5 * std::cos(0.2 * M_PI * seconds);
    data.velocity = 0.7;
    data.time = std::to_string(static_cast<long>(seconds));
    return data;
}

} // namespace tandem::devices
