// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_io.hpp"

#include <device/AnalogDigitalIo.h>

using namespace tandem::devices;

TANDEM_DEVICE(AnalogDigitalIo, SimulatedAnalog<SimulatedDigital<SimulatedDevice<AnalogDigitalIo>>>)
