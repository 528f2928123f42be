// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/Encoder.h>

namespace {

/// Shafts that turn at 1 rad/s; rad.
class SimulatedEncoder : public tandem::devices::SimulatedSensor<Encoder, double> {
    double at(int channel, double seconds) override { return seconds + channel; }
};

} // namespace

TANDEM_DEVICE(SimulatedEncoder)
