// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MOUSE3D_H_
#define DEVICE_MOUSE3D_H_

#include "Device.h"

/// A mouse with three axes: OPRoS v1.
class Mouse3D : public Device {
  public:
    Mouse3D() {}
    virtual ~Mouse3D() {}
    virtual int GetPosition(double& /*x*/, double& /*y*/, double& /*z*/) { return API_NOT_SUPPORTED; }
};

#endif
