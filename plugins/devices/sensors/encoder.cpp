// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/Encoder.h>

/// Returns the angles of shafts that turn at 1 rad/s. Each is 1 rad ahead of the previous one; rad.
static double shaft_angle(int channel, double seconds) { return seconds + channel; }

TANDEM_DEVICE(Encoder, tandem::devices::FunctionSensor<Encoder, double, shaft_angle>)
