// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/TorqueSensor.h>

namespace {

/// Up to 1 Nm either way.
class SimulatedTorqueSensor : public tandem::devices::SimulatedSensor<TorqueSensor, double> {
    double at(int channel, double seconds) override { return wave(channel, seconds); }
};

} // namespace

TANDEM_DEVICE(SimulatedTorqueSensor)
