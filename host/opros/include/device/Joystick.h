// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_JOYSTICK_H_
#define DEVICE_JOYSTICK_H_

#include "Device.h"

/// Axes and buttons.
class Joystick : public Device {
  public:
    Joystick() {}
    virtual ~Joystick() {}
    virtual int GetJoystickData(JoystickData&) { return API_NOT_SUPPORTED; }
};

#endif
