// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_USB_V1_H_
#define DEVICE_USB_V1_H_

#include "Usb.h"

/// Its name in OPRoS v1.
typedef Usb USB;

#endif
