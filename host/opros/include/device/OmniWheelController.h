// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_OMNIWHEELCONTROLLER_H_
#define DEVICE_OMNIWHEELCONTROLLER_H_

#include "WheelController.h"

/// A base that can move sideways: OPRoS v1.
class OmniWheelController : public WheelController {
  public:
    OmniWheelController() {}
    virtual ~OmniWheelController() {}
};

#endif
