// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_HUMIDITYSENSOR_H_
#define DEVICE_HUMIDITYSENSOR_H_

#include "Sensor.h"

/// Humidities, beginning with the sensor `index`: OPRoS v1.
class HumiditySensor : public Sensor {
  public:
    HumiditySensor() {}
    virtual ~HumiditySensor() {}
    virtual int GetHumiditySensorData(int /*index*/, double* /*data*/, int /*size*/) {
        return API_NOT_SUPPORTED;
    }
};

#endif
