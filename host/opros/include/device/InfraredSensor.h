// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_INFRAREDSENSOR_H_
#define DEVICE_INFRAREDSENSOR_H_

#include "Sensor.h"

/// Distances, one per sensor.
class InfraredSensor : public Sensor {
  public:
    InfraredSensor() {}
    virtual ~InfraredSensor() {}
    virtual int GetSensorValue(std::vector<double>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetInfraredSensorData(std::vector<double>& values) { return GetSensorValue(values); }
};

#endif
