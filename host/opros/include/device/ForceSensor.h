// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_FORCESENSOR_H_
#define DEVICE_FORCESENSOR_H_

#include "Sensor.h"

/// Forces, one per sensor.
class ForceSensor : public Sensor {
  public:
    ForceSensor() {}
    virtual ~ForceSensor() {}
    virtual int GetSensorValue(std::vector<double>&) { return API_NOT_SUPPORTED; }
};

#endif
