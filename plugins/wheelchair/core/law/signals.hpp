// SPDX-License-Identifier: Apache-2.0
// The values that the components exchange, as used by the laws. ports.hpp defines their format on a port.
#pragma once

namespace tandem::wheelchair {

/// From HWComp to JoystickComp.
struct JoystickPosition {
    double x = 0, y = 0; // counts -2000..2000, x > 0 left, y > 0 forward
    bool emergency_stop = false;
};

/// From JoystickComp to ControlComp.
struct Reference {
    double direction_deg = 0.0, speed = 0.0; // deg, m/s
};

/// From HWComp to ControlComp.
struct WheelSpeed {
    double left = 0.0, right = 0.0; // rad/s from encoder counts
    bool emergency_stop = false;
    double count_left = 0.0, count_right = 0.0; // encoder counts since the start
};

/// From ControlComp to HWComp.
struct Voltage {
    double left = 0.0, right = 0.0; // V
    bool brake = true;
};

/// A value with its sender's time stamp [s] and sequence number.
template <class T>
struct Stamped {
    double stamp = 0.0, sequence = 0.0;
    T value{};
};

} // namespace tandem::wheelchair
