// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MOBILEPOSITIONDATA_H_
#define DEVICE_MOBILEPOSITIONDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// The position and heading of a mobile base. OPRoS v2.
OPROS_API_THREE_NUMBERS(MobilePositionData, x, y, theta)

} // namespace OPRoS

#endif
