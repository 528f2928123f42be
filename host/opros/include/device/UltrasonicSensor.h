// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ULTRASONICSENSOR_H_
#define DEVICE_ULTRASONICSENSOR_H_

#include "Sensor.h"

/// Distances, one per sensor.
class UltrasonicSensor : public Sensor {
  public:
    UltrasonicSensor() {}
    virtual ~UltrasonicSensor() {}
    virtual int GetSensorValue(std::vector<double>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetUltrasonicSensorData(std::vector<double>& values) { return GetSensorValue(values); }
};

#endif
