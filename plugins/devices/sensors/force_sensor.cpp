// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/ForceSensor.h>

namespace {

/// Up to 10 N either way.
class SimulatedForceSensor : public tandem::devices::SimulatedSensor<ForceSensor, double> {
    double at(int channel, double seconds) override { return 10 * wave(channel, seconds); }
};

} // namespace

TANDEM_DEVICE(SimulatedForceSensor)
