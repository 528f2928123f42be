// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/ForceTorqueSensor.h>

namespace {

/// A load of 10 N that swings; N, Nm.
class SimulatedForceTorqueSensor
    : public tandem::devices::SimulatedSensor<ForceTorqueSensor, ForceTorqueSensorData> {
    ForceTorqueSensorData at(int channel, double seconds) override {
        return ForceTorqueSensorData(wave(channel, seconds), 0, 10, 0, 0, 0.1 * wave(channel, seconds));
    }
};

} // namespace

TANDEM_DEVICE(SimulatedForceTorqueSensor)
