// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_bus.hpp"

#include <device/Socket.h>

TANDEM_DEVICE(Socket, tandem::devices::SimulatedBus<Socket>)
