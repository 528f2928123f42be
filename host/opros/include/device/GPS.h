// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_GPS_H_
#define DEVICE_GPS_H_

#include "Sensor.h"

/// The position on the earth: OPRoS v1.
class GPS : public Sensor {
  public:
    GPS() {}
    virtual ~GPS() {}
    virtual int GetGPSData(GPSData&) { return API_NOT_SUPPORTED; }
};

#endif
