// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/actuators/simulated_drive.hpp"

#include <device/Actuator.h>

TANDEM_DEVICE(Actuator, tandem::devices::SimulatedDrive<Actuator>)
