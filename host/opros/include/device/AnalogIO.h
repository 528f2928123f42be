// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ANALOGIO_V1_H_
#define DEVICE_ANALOGIO_V1_H_

#include "AnalogIo.h"

/// Its name in OPRoS v1.
typedef AnalogIo AnalogIO;

#endif
