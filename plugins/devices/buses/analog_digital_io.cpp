// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_io.hpp"

#include <device/AnalogDigitalIo.h>

namespace {
using namespace tandem::devices;
class SimulatedAnalogDigitalIo : public SimulatedAnalog<SimulatedDigital<SimulatedDevice<AnalogDigitalIo>>> {
};
} // namespace

TANDEM_DEVICE(SimulatedAnalogDigitalIo)
