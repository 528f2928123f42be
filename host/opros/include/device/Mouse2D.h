// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MOUSE2D_H_
#define DEVICE_MOUSE2D_H_

#include "Device.h"

/// A mouse. OPRoS v1 has this file without content.
class Mouse2D : public Device {
  public:
    Mouse2D() {}
    virtual ~Mouse2D() {}
    virtual int GetPosition(double& /*x*/, double& /*y*/) { return API_NOT_SUPPORTED; }
};

#endif
