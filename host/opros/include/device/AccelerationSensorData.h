// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ACCELERATIONSENSORDATA_H_
#define DEVICE_ACCELERATIONSENSORDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// Accelerations in three axes. OPRoS v2.
OPROS_API_THREE_NUMBERS(AccelerationSensorData, xAcceleration, yAcceleration, zAcceleration)

} // namespace OPRoS

#endif
