// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The service of JoystickComp.
class IJoystick {
  public:
    virtual ~IJoystick() = default;
    virtual double dead_zone() = 0;      // counts
    virtual double direction_rate() = 0; // deg/s, 0 = not limited
};
