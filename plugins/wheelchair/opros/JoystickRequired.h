// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OPRoSTypes.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>

#include "IJoystick.h"

/// Required port of service IJoystick. Calls throw MethodInvokeException if nothing is connected or the provider fails.
class JoystickRequired : public RequiredServicePort, public IJoystick {
  public:
    JoystickRequired() {
        dead_zone_ = add("dead_zone", makeRequiredMethod(&JoystickRequired::dead_zone, "dead_zone"));
        direction_rate_ =
            add("direction_rate", makeRequiredMethod(&JoystickRequired::direction_rate, "direction_rate"));
    }

    double dead_zone() override { return (*dead_zone_)(); }
    double direction_rate() override { return (*direction_rate_)(); }

  private:
    RequiredMethod<double>* add(const char* name, Method* method) {
        addMethod(name, method);
        return reinterpret_cast<RequiredMethod<double>*>(method);
    }

    RequiredMethod<double>* dead_zone_;
    RequiredMethod<double>* direction_rate_;
};
