// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_GPSDATA_H_
#define DEVICE_GPSDATA_H_

#include "ApiMembers.h"
#include "ApiValues.h"

namespace OPRoS {

/// A position on the earth in degrees, with time and velocity. OPRoS v2; v1.1's is ::GpsData (ApiTypes.h).
class GpsData {
  public:
    ReturnType status = OPROS_SUCCESS;
    float64_t latitude = 0, longitude = 0;
    std::string time;
    float64_t velocity = 0;
    GpsData() {}
    GpsData(float64_t latitude_, float64_t longitude_, std::string time_, float64_t velocity_)
        : latitude(latitude_), longitude(longitude_), time(time_), velocity(velocity_) {}
    OPROS_API_MEMBERS(status, latitude, longitude, time, velocity)
};
OPROS_API_TYPE_NAME(GpsData)

} // namespace OPRoS

#endif
