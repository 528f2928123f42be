// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/BumperSensor.h>

namespace {

/// Now and then a touch.
class SimulatedBumperSensor : public tandem::devices::SimulatedSensor<BumperSensor, bool> {
    bool at(int channel, double seconds) override { return wave(channel, seconds) > 0.9; }
};

} // namespace

TANDEM_DEVICE(SimulatedBumperSensor)
