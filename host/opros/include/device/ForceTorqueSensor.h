// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_FORCETORQUESENSOR_H_
#define DEVICE_FORCETORQUESENSOR_H_

#include "Sensor.h"

/// Forces and torques in three axes.
class ForceTorqueSensor : public Sensor {
  public:
    ForceTorqueSensor() {}
    virtual ~ForceTorqueSensor() {}
    virtual int GetSensorValue(std::vector<ForceTorqueSensorData>&) { return API_NOT_SUPPORTED; }
};

#endif
