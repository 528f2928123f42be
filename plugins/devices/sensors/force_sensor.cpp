// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/ForceSensor.h>

/// Returns up to 10 N in both directions.
static double force(int channel, double seconds) { return 10 * tandem::devices::sine(channel, seconds); }

TANDEM_DEVICE(ForceSensor, tandem::devices::FunctionSensor<ForceSensor, double, force>)
