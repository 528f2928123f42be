// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_BUMPERSENSOR_H_
#define DEVICE_BUMPERSENSOR_H_

#include "Sensor.h"

/// The name that components of OPRoS v1 use.
class BumperSensorProfile : public SensorProfile {};

/// Bumpers: which of them touch something.
class BumperSensor : public Sensor {
  public:
    BumperSensor() {}
    virtual ~BumperSensor() {}
    virtual int GetSensorValue(std::vector<bool>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetBumperSensorData(std::vector<bool>& values) { return GetSensorValue(values); }
};

#endif
