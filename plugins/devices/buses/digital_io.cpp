// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_io.hpp"

#include <device/DigitalIo.h>

using namespace tandem::devices;

TANDEM_DEVICE(DigitalIo, SimulatedDigital<SimulatedDevice<DigitalIo>>)
