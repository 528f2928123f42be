// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_USB_H_
#define DEVICE_USB_H_

#include "Bus.h"

/// A USB connection. Read and Write transfer at most `size` bytes.
class Usb : public Bus {
  public:
    Usb() {}
    virtual ~Usb() {}
    virtual int Write(unsigned char* /*data*/, int /*size*/) { return API_NOT_SUPPORTED; }
    virtual int Read(unsigned char* /*data*/, int /*size*/) { return API_NOT_SUPPORTED; }
};

#endif
