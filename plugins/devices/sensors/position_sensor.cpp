// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/PositionSensor.h>

namespace {

/// Drives round a circle of 1 m; m, rad.
class SimulatedPositionSensor : public tandem::devices::SimulatedSensor<PositionSensor, ObjectPosition> {
    ObjectPosition at(int channel, double seconds) override {
        return ObjectPosition(std::cos(0.2 * M_PI * seconds), std::sin(0.2 * M_PI * seconds), 0, 0, 0,
                              0.2 * M_PI * seconds + M_PI / 2 + channel);
    }
};

} // namespace

TANDEM_DEVICE(SimulatedPositionSensor)
