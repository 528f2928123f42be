// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_DIGITALIO_V1_H_
#define DEVICE_DIGITALIO_V1_H_

#include "DigitalIo.h"

/// Its name in OPRoS v1.
typedef DigitalIo DigitalIO;

#endif
