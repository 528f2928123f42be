// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_bus.hpp"

#include <device/Usb.h>

namespace {
class SimulatedUsb : public tandem::devices::SimulatedBus<Usb> {};
} // namespace

TANDEM_DEVICE(SimulatedUsb)
