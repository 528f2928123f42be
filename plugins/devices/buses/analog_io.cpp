// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_io.hpp"

#include <device/AnalogIo.h>

namespace {
using namespace tandem::devices;
class SimulatedAnalogIo : public SimulatedAnalog<SimulatedDevice<AnalogIo>> {};
} // namespace

TANDEM_DEVICE(SimulatedAnalogIo)
