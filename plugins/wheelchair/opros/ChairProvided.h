// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>
#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>

#include "IChair.h"

/// Provided port of service IChair. Passes each call to the component, in the caller's thread.
class ChairProvided : public ProvidedServicePort {
  public:
    explicit ChairProvided(IChair* component) {
        addMethod("parameters", makeProvidedMethod(&IChair::parameters, component, "parameters"));
        addMethod("limits", makeProvidedMethod(&IChair::limits, component, "limits"));
        addMethod("emergency_stop", makeProvidedMethod(&IChair::emergency_stop, component, "emergency_stop"));
    }
};
