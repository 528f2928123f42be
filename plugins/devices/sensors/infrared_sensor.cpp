// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/InfraredSensor.h>

namespace {

/// Things 0.2 to 0.8 m away.
class SimulatedInfraredSensor : public tandem::devices::SimulatedSensor<InfraredSensor, double> {
    double at(int channel, double seconds) override { return 0.5 + 0.3 * wave(channel, seconds); }
};

} // namespace

TANDEM_DEVICE(SimulatedInfraredSensor)
