// SPDX-License-Identifier: Apache-2.0
// Data types that only device components of OPRoS v1 have. Part of ApiTypes.h, which components include.
#ifndef DEVICE_APITYPES_V1_H_
#define DEVICE_APITYPES_V1_H_

#include "ApiMembers.h"

#include <string>
#include <vector>

class WheelControlVelocity {
  public:
    double forward = 0, angular = 0;
    OPROS_API_MEMBERS(forward, angular)
};
OPROS_API_TYPE_NAME(WheelControlVelocity)

class GPSData {
  public:
    double latitude = 0, longitude = 0;
    std::string time;
    double velocity = 0;
    OPROS_API_MEMBERS(latitude, longitude, time, velocity)
};
OPROS_API_TYPE_NAME(GPSData)

class CANObject {
  public:
    long id = 0;
    std::vector<unsigned char> data;
    OPROS_API_MEMBERS(id, data)
};
OPROS_API_TYPE_NAME(CANObject)

#endif
