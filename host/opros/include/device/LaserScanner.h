// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_LASERSCANNER_H_
#define DEVICE_LASERSCANNER_H_

#include "Sensor.h"

/// Distances of one sweep in the order of the beams.
class LaserScanner : public Sensor {
  public:
    LaserScanner() {}
    virtual ~LaserScanner() {}
    virtual int GetSensorValue(std::vector<double>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetLaserScannerData(std::vector<double>& values) { return GetSensorValue(values); }
};

#endif
