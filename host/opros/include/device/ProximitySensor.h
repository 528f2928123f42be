// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_PROXIMITYSENSOR_H_
#define DEVICE_PROXIMITYSENSOR_H_

#include "Sensor.h"

/// Distances of near objects, one list per sensor. OPRoS v2.
class ProximitySensor : public Sensor {
  public:
    ProximitySensor() {}
    virtual ~ProximitySensor() {}
    virtual std::int32_t GetSensorValue(std::vector<OPRoS::Float64Array>&) { return API_NOT_SUPPORTED; }
};

#endif
