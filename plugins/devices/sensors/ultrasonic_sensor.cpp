// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/UltrasonicSensor.h>

namespace {

/// Things 1 to 3 m away.
class SimulatedUltrasonicSensor : public tandem::devices::SimulatedSensor<UltrasonicSensor, double> {
    double at(int channel, double seconds) override { return 2 + wave(channel, seconds); }
};

} // namespace

TANDEM_DEVICE(SimulatedUltrasonicSensor)
