// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_arm.hpp"

#include <device/Manipulator.h>

namespace {
class SimulatedManipulator : public tandem::devices::SimulatedArm<Manipulator> {};
} // namespace

TANDEM_DEVICE(SimulatedManipulator)
