// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OBJECTACCELERATIONDATA_H_
#define DEVICE_OBJECTACCELERATIONDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// Linear and angular accelerations. OPRoS v2.
OPROS_API_SIX_NUMBERS(ObjectAccelerationData, x, y, z, roll, pitch, yaw)

} // namespace OPRoS

#endif
