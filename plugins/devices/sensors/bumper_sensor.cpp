// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/BumperSensor.h>

/// Returns true for 1.4 s of every 10 s.
static bool is_touched(int channel, double seconds) { return tandem::devices::sine(channel, seconds) > 0.9; }

TANDEM_DEVICE(BumperSensor, tandem::devices::FunctionSensor<BumperSensor, bool, is_touched>)
