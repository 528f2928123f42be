// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MOBILEACCELERATIONDATA_H_
#define DEVICE_MOBILEACCELERATIONDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// The accelerations of a mobile base. OPRoS v2.
OPROS_API_THREE_NUMBERS(MobileAccelerationData, x, y, theta)

} // namespace OPRoS

#endif
