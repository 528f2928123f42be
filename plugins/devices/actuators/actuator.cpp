// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_drive.hpp"

#include <device/Actuator.h>

namespace {
class SimulatedActuator : public tandem::devices::SimulatedDrive<Actuator> {};
} // namespace

TANDEM_DEVICE(SimulatedActuator)
