// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/TouchSensor.h>

namespace {

/// Now and then a touch.
class SimulatedTouchSensor : public tandem::devices::SimulatedSensor<TouchSensor, bool> {
    bool at(int channel, double seconds) override { return wave(channel, seconds) > 0.9; }
};

} // namespace

TANDEM_DEVICE(SimulatedTouchSensor)
