// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/ProximitySensor.h>

/// Returns the distance of one object, between 0.1 and 0.5 m.
static OPRoS::Float64Array distances(int channel, double seconds) {
    return std::vector<double>{0.3 + 0.2 * tandem::devices::sine(channel, seconds)};
}

TANDEM_DEVICE(ProximitySensor,
              tandem::devices::FunctionSensor<ProximitySensor, OPRoS::Float64Array, distances>)
