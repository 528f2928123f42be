// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_UART_V1_H_
#define DEVICE_UART_V1_H_

#include "Uart.h"

/// The name it has in OPRoS v1.
typedef Uart UART;

#endif
