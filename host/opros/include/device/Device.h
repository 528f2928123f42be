// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_DEVICE_H_
#define DEVICE_DEVICE_H_

#include "OprosApi.h"

/// What a device reports about itself. This host does not read it.
enum DEVICE_STATUS { DEVICE_CREATED = 0x01, DEVICE_READY = 0x02, DEVICE_ACTIVE = 0x03, DEVICE_ERROR = 0x04 };

/// Base class of devices.
class Device : public OprosApi {
  public:
    Device() : _status(DEVICE_CREATED) {}
    virtual ~Device() {}
    DEVICE_STATUS GetStatus() { return _status; }

  protected:
    DEVICE_STATUS _status;
};

#endif
