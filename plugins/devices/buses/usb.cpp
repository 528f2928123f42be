// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_bus.hpp"

#include <device/Usb.h>

TANDEM_DEVICE(Usb, tandem::devices::SimulatedBus<Usb>)
