// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_I2C_H_
#define DEVICE_I2C_H_

#include "Bus.h"

/// An I2C bus. Read and Write transfer `size` bytes from or to the device with this address.
class I2C : public Bus {
  public:
    I2C() {}
    virtual ~I2C() {}
    virtual int Write(unsigned long /*address*/, unsigned char* /*data*/, int /*size*/) {
        return API_NOT_SUPPORTED;
    }
    virtual int Read(unsigned long /*address*/, unsigned char* /*data*/, int /*size*/) {
        return API_NOT_SUPPORTED;
    }
};

#endif
