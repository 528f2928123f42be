// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OBJECTPOSITIONDATA_H_
#define DEVICE_OBJECTPOSITIONDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// A position and an attitude. OPRoS v2.
OPROS_API_SIX_NUMBERS(ObjectPositionData, x, y, z, roll, pitch, yaw)

} // namespace OPRoS

#endif
