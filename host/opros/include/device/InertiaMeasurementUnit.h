// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_INERTIAMEASUREMENTUNIT_H_
#define DEVICE_INERTIAMEASUREMENTUNIT_H_

#include "Sensor.h"

/// Turning rates, accelerations and attitude.
class InertiaMeasurementUnit : public Sensor {
  public:
    InertiaMeasurementUnit() {}
    virtual ~InertiaMeasurementUnit() {}
    virtual int GetSensorValue(std::vector<ObjectPosture>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetInertiaMeasurementUnitData(std::vector<ObjectPosture>& values) {
        return GetSensorValue(values);
    }
};

#endif
