// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_GEOMAGNETICSENSORDATA_H_
#define DEVICE_GEOMAGNETICSENSORDATA_H_

#include "ApiData.h"

namespace OPRoS {

/// A magnetic field in three axes, its rates of change, and the angles to it. OPRoS v2.
OPROS_API_NINE_NUMBERS(GeoMagneticSensorData, xGauss, yGauss, zGauss, xGaussRate, yGaussRate, zGaussRate,
                       xAlpha, yAlpha, zAlpha)

} // namespace OPRoS

#endif
