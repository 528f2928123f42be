// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_CARTESIANCOORDINATEDATA_H_
#define DEVICE_CARTESIANCOORDINATEDATA_H_

#include "ApiTypes.h"

namespace OPRoS {
/// Its name in OPRoS v2.
typedef ::CartesianCoordinate CartesianCoordinate;
} // namespace OPRoS

#endif
