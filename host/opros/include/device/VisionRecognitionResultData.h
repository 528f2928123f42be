// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_VISIONRECOGNITIONRESULTDATA_H_
#define DEVICE_VISIONRECOGNITIONRESULTDATA_H_

#include "ApiTypes.h"

namespace OPRoS {
/// Its name in OPRoS v2.
typedef ::VisionRecognitionResult VisionRecognitionResult;
} // namespace OPRoS

#endif
