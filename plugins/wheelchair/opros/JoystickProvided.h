// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>
#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>

#include "IJoystick.h"

/// Provided port of service IJoystick. Passes each call to the component, in the caller's thread.
class JoystickProvided : public ProvidedServicePort {
  public:
    explicit JoystickProvided(IJoystick* component) {
        addMethod("dead_zone", makeProvidedMethod(&IJoystick::dead_zone, component, "dead_zone"));
        addMethod("direction_rate",
                  makeProvidedMethod(&IJoystick::direction_rate, component, "direction_rate"));
    }
};
