// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/buses/simulated_io.hpp"

#include <device/DigitalIo.h>

namespace {
using namespace tandem::devices;
class SimulatedDigitalIo : public SimulatedDigital<SimulatedDevice<DigitalIo>> {};
} // namespace

TANDEM_DEVICE(SimulatedDigitalIo)
