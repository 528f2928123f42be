// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_TOUCHSENSOR_H_
#define DEVICE_TOUCHSENSOR_H_

#include "Sensor.h"

/// Which of the sensors are touched.
class TouchSensor : public Sensor {
  public:
    TouchSensor() {}
    virtual ~TouchSensor() {}
    virtual int GetSensorValue(std::vector<bool>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetTouchSensorData(std::vector<bool>& values) { return GetSensorValue(values); }
};

#endif
