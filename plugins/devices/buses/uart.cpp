// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_bus.hpp"

#include <device/Uart.h>

namespace {
class SimulatedUart : public tandem::devices::SimulatedBus<Uart> {};
} // namespace

TANDEM_DEVICE(SimulatedUart)
