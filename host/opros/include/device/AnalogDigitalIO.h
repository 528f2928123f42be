// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ANALOGDIGITALIO_V1_H_
#define DEVICE_ANALOGDIGITALIO_V1_H_

#include "AnalogDigitalIo.h"

/// Its name in OPRoS v1.
typedef AnalogDigitalIo AnalogDigitalIO;

#endif
