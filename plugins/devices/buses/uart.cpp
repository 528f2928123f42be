// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_bus.hpp"

#include <device/Uart.h>

TANDEM_DEVICE(Uart, tandem::devices::SimulatedBus<Uart>)
