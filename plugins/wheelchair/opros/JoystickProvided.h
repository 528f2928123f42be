// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>
#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>

#include "IJoystick.h"

/// Provided port of service IJoystick: hands each call to the component.
class JoystickProvided : public ProvidedServicePort {
  public:
    explicit JoystickProvided(IJoystick* component) {
        addMethod("dead_zone", makeProvidedMethod(&IJoystick::dead_zone, component, "dead_zone"));
        addMethod("direction_rate",
                  makeProvidedMethod(&IJoystick::direction_rate, component, "direction_rate"));
    }
};
