// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_GLOBALPOSITIONINGSYSTEM_H_
#define DEVICE_GLOBALPOSITIONINGSYSTEM_H_

#include "Sensor.h"

/// The position on the earth.
class GlobalPositioningSystem : public Sensor {
  public:
    GlobalPositioningSystem() {}
    virtual ~GlobalPositioningSystem() {}
    virtual int GetSensorValue(std::vector<GpsData>&) { return API_NOT_SUPPORTED; }
};

#endif
