// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MOBILEVELOCITYDATA_H_
#define DEVICE_MOBILEVELOCITYDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// The velocities of a mobile base: forward, to the left, and turning. OPRoS v2.
OPROS_API_THREE_NUMBERS(MobileVelocityData, x, y, theta)

} // namespace OPRoS

#endif
