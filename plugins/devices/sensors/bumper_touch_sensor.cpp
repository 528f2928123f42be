// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/BumperTouchSensor.h>

/// Returns true for 1.4 s of every 10 s.
static OPRoS::Bool is_bumper_pressed(int channel, double seconds) {
    return tandem::devices::sine(channel, seconds) > 0.9;
}

TANDEM_DEVICE(BumperTouchSensor,
              tandem::devices::FunctionSensor<BumperTouchSensor, OPRoS::Bool, is_bumper_pressed>)
