// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ACTUATOR_H_
#define DEVICE_ACTUATOR_H_

#include "Device.h"

/// The limits of a drive, for components that store them.
class ActuatorProfile {
  public:
    ActuatorProfile() : maximumPower(0) {}
    virtual ~ActuatorProfile() {}
    double maximumPower;
};

/// A drive controlled by power. `time` is how long it may take to reach the power, in milliseconds; 0: at once.
class Actuator : public Device {
  public:
    Actuator() {}
    virtual ~Actuator() {}
    virtual int SetPower(double /*power*/, unsigned long /*time*/ = 0) { return API_NOT_SUPPORTED; }
    virtual int GetPower(double&) { return API_NOT_SUPPORTED; }
};

#endif
