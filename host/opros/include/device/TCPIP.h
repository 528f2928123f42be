// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_TCPIP_V1_H_
#define DEVICE_TCPIP_V1_H_

#include "Socket.h"

/// Its name in OPRoS v1.
typedef Socket TCPIP;

#endif
