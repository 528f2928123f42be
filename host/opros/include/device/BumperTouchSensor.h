// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_BUMPERTOUCHSENSOR_H_
#define DEVICE_BUMPERTOUCHSENSOR_H_

#include "Sensor.h"

/// Which bumpers are pressed. OPRoS v2; v1.1 has BumperSensor.
class BumperTouchSensor : public Sensor {
  public:
    BumperTouchSensor() {}
    virtual ~BumperTouchSensor() {}
    virtual std::int32_t GetSensorValue(std::vector<OPRoS::Bool>&) { return API_NOT_SUPPORTED; }
};

#endif
