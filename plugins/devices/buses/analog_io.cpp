// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_io.hpp"

#include <device/AnalogIo.h>

using namespace tandem::devices;

TANDEM_DEVICE(AnalogIo, SimulatedAnalog<SimulatedDevice<AnalogIo>>)
