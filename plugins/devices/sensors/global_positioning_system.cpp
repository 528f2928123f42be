// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"
#include "plugins/devices/sensors/simulated_walk.hpp"

#include <device/GlobalPositioningSystem.h>

/// The receiver of OPRoS v1.1. All channels receive the same data.
static GpsData receive(int, double seconds) { return tandem::devices::walk_on_circle<GpsData>(seconds); }

TANDEM_DEVICE(GlobalPositioningSystem,
              tandem::devices::FunctionSensor<GlobalPositioningSystem, GpsData, receive>)
