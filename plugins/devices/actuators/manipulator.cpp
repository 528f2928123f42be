// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_arm.hpp"

#include <device/Manipulator.h>

TANDEM_DEVICE(Manipulator, tandem::devices::SimulatedArm<Manipulator>)
