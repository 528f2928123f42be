// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_bus.hpp"

#include <device/Socket.h>

namespace {
class SimulatedSocket : public tandem::devices::SimulatedBus<Socket> {};
} // namespace

TANDEM_DEVICE(SimulatedSocket)
