// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_GYROSENSOR_H_
#define DEVICE_GYROSENSOR_H_

#include "GyroSensorData.h"
#include "Sensor.h"

/// Attitudes.
class GyroSensor : public Sensor {
  public:
    GyroSensor() {}
    virtual ~GyroSensor() {}
    virtual int GetSensorValue(std::vector<ObjectRotation>&) { return API_NOT_SUPPORTED; }
    /// The form of OPRoS v2.
    virtual std::int32_t GetSensorValue(std::vector<OPRoS::GyroSensorData>&) { return API_NOT_SUPPORTED; }
    /// The form of OPRoS v1: the heading is theta.
    virtual int GetGyroSensorData(std::vector<ObjectLocation>&) { return API_NOT_SUPPORTED; }
};

#endif
