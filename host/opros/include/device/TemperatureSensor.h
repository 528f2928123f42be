// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_TEMPERATURESENSOR_H_
#define DEVICE_TEMPERATURESENSOR_H_

#include "Sensor.h"

/// Temperatures, beginning with the sensor `index`: OPRoS v1.
class TemperatureSensor : public Sensor {
  public:
    TemperatureSensor() {}
    virtual ~TemperatureSensor() {}
    virtual int GetTemperatureSensorData(int /*index*/, double* /*data*/, int /*size*/) {
        return API_NOT_SUPPORTED;
    }
};

#endif
