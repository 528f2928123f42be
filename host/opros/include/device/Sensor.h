// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_SENSOR_H_
#define DEVICE_SENSOR_H_

#include "Device.h"

/// The position and attitude of a sensor on its robot.
class SensorProfile {
  public:
    SensorProfile() : x(0), y(0), z(0), roll(0), pitch(0), yaw(0) {}
    virtual ~SensorProfile() {}
    double x, y, z, roll, pitch, yaw;
};

/// A device that is read. The derived classes' Get functions return the last measurement, one element per sensor,
/// axis or beam. The device chooses the units; the simulated devices (plugins/devices) use m, rad, s, N and V.
class Sensor : public Device {
  public:
    Sensor() {}
    virtual ~Sensor() {}
};

#endif
