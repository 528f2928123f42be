// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_BUS_H_
#define DEVICE_BUS_H_

#include "Device.h"
#include "OprosLock.h"

/// A line that several devices share. A user holds the recursive lock during an exchange.
class Bus : public Device {
  public:
    Bus() {}
    virtual ~Bus() {}
    virtual int Lock() {
        _lock.Lock();
        return API_SUCCESS;
    }
    virtual int Unlock() {
        _lock.Unlock();
        return API_SUCCESS;
    }

  private:
    OprosLock _lock;
};

#endif
