// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_DISTANCESENSOR_H_
#define DEVICE_DISTANCESENSOR_H_

#include "Sensor.h"

/// Distances in metres, beginning with the sensor `index`: OPRoS v1.
class DistanceSensor : public Sensor {
  public:
    DistanceSensor() {}
    virtual ~DistanceSensor() {}
    virtual int GetDistanceSensorData(int /*index*/, double* /*data*/, int /*size*/) {
        return API_NOT_SUPPORTED;
    }
};

#endif
