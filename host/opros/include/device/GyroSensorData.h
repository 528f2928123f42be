// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_GYROSENSORDATA_H_
#define DEVICE_GYROSENSORDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// Angles and turning rates about three axes. OPRoS v2.
OPROS_API_SIX_NUMBERS(GyroSensorData, xAngle, yAngle, zAngle, xAngleRate, yAngleRate, zAngleRate)

} // namespace OPRoS

#endif
