// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_LASERRANGEFINDER_H_
#define DEVICE_LASERRANGEFINDER_H_

#include "Sensor.h"

/// Distances, one list per scanner. OPRoS v2; v1.1 has LaserScanner.
class LaserRangeFinder : public Sensor {
  public:
    LaserRangeFinder() {}
    virtual ~LaserRangeFinder() {}
    virtual std::int32_t GetSensorValue(std::vector<OPRoS::Float64Array>&) { return API_NOT_SUPPORTED; }
};

#endif
