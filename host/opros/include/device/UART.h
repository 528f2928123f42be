// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_UART_V1_H_
#define DEVICE_UART_V1_H_

#include "Uart.h"

/// Its name in OPRoS v1.
typedef Uart UART;

#endif
