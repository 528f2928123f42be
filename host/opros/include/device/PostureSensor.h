// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_POSTURESENSOR_H_
#define DEVICE_POSTURESENSOR_H_

#include "Sensor.h"

/// Attitudes, beginning with the sensor `index`: OPRoS v1.
class PostureSensor : public Sensor {
  public:
    PostureSensor() {}
    virtual ~PostureSensor() {}
    virtual int GetPostureSensorData(int /*index*/, ObjectPosture* /*data*/, int /*size*/) {
        return API_NOT_SUPPORTED;
    }
};

#endif
