// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_SENSOR_H_
#define DEVICE_SENSOR_H_

#include "Device.h"

/// Where a sensor sits on its robot.
class SensorProfile {
  public:
    SensorProfile() : x(0), y(0), z(0), roll(0), pitch(0), yaw(0) {}
    virtual ~SensorProfile() {}
    double x, y, z, roll, pitch, yaw;
};

/// A device that is read: the derived classes' Get functions fill in the last measurement, one element per sensor, axis
/// or beam. Units are the device's own; the simulated ones (plugins/devices) measure in m, rad, s, N and V.
class Sensor : public Device {
  public:
    Sensor() {}
    virtual ~Sensor() {}
};

#endif
