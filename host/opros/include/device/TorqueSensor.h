// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_TORQUESENSOR_H_
#define DEVICE_TORQUESENSOR_H_

#include "Sensor.h"

/// Torques, one per sensor.
class TorqueSensor : public Sensor {
  public:
    TorqueSensor() {}
    virtual ~TorqueSensor() {}
    virtual int GetSensorValue(std::vector<double>&) { return API_NOT_SUPPORTED; }
};

#endif
