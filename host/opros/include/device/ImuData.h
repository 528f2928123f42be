// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_IMUDATA_H_
#define DEVICE_IMUDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// Turning rates, accelerations and attitude of an inertial unit. OPRoS v2.
OPROS_API_NINE_NUMBERS(ImuData, pRate, qRate, rRate, xAcceleration, yAcceleration, zAcceleration, roll, pitch,
                       yaw)

} // namespace OPRoS

#endif
