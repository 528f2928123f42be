// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_POSITIONSENSOR_H_
#define DEVICE_POSITIONSENSOR_H_

#include "Sensor.h"

/// Positions and attitudes.
class PositionSensor : public Sensor {
  public:
    PositionSensor() {}
    virtual ~PositionSensor() {}
    virtual int GetSensorValue(std::vector<ObjectPosition>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetPositionSensorData(std::vector<ObjectPosition>& values) { return GetSensorValue(values); }
};

#endif
