// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ACCELERATIONSENSOR_H_
#define DEVICE_ACCELERATIONSENSOR_H_

#include "AccelerationSensorData.h"
#include "Sensor.h"

/// Accelerations, one per axis.
class AccelerationSensor : public Sensor {
  public:
    AccelerationSensor() {}
    virtual ~AccelerationSensor() {}
    virtual int GetSensorValue(std::vector<double>&) { return API_NOT_SUPPORTED; }
    /// The form of OPRoS v2, one element per sensor.
    virtual std::int32_t GetSensorValue(std::vector<OPRoS::AccelerationSensorData>&) {
        return API_NOT_SUPPORTED;
    }
    /// Its name in OPRoS v1.
    virtual int GetAccelerationSensorData(std::vector<double>& values) { return GetSensorValue(values); }
};

#endif
