// SPDX-License-Identifier: Apache-2.0
// The values that travel between the components, as the laws see them (messages.hpp: as they look on a port).
#pragma once

namespace tandem::wheelchair {

struct JoystickPosition {
    double x = 0, y = 0; // counts -2000..2000, x > 0 left, y > 0 forward
    bool emergency_stop = false;
};

struct Reference {
    double direction_deg = 0.0, speed = 0.0; // deg, m/s
};

struct WheelSpeed {
    double left = 0.0, right = 0.0; // rad/s from encoder counts
    bool emergency_stop = false;
    double count_left = 0.0, count_right = 0.0;
};

struct Voltage {
    double left = 0.0, right = 0.0; // V
    bool brake = true;
};

/// A value with the stamp (s) and sequence number its sender gave it.
template <class T>
struct Stamped {
    double stamp = 0.0, sequence = 0.0;
    T value{};
};

} // namespace tandem::wheelchair
