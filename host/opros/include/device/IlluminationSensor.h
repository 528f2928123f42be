// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ILLUMINATIONSENSOR_H_
#define DEVICE_ILLUMINATIONSENSOR_H_

#include "Sensor.h"

/// Brightnesses, beginning with the sensor `index`: OPRoS v1.
class IlluminationSensor : public Sensor {
  public:
    IlluminationSensor() {}
    virtual ~IlluminationSensor() {}
    virtual int GetIlluminationSensorData(int /*index*/, double* /*data*/, int /*size*/) {
        return API_NOT_SUPPORTED;
    }
};

#endif
