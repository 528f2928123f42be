// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OBJECTVELOCITYDATA_H_
#define DEVICE_OBJECTVELOCITYDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// Linear velocities and turning rates. OPRoS v2.
OPROS_API_SIX_NUMBERS(ObjectVelocityData, x, y, z, roll, pitch, yaw)

} // namespace OPRoS

#endif
