// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_GPS_H_
#define DEVICE_GPS_H_

#include "Sensor.h"

/// Where on the earth it is: OPRoS v1.
class GPS : public Sensor {
  public:
    GPS() {}
    virtual ~GPS() {}
    virtual int GetGPSData(GPSData&) { return API_NOT_SUPPORTED; }
};

#endif
