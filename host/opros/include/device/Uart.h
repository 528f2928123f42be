// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_UART_H_
#define DEVICE_UART_H_

#include "Bus.h"

/// A serial line. Read and Write transfer at most `size` bytes.
class Uart : public Bus {
  public:
    Uart() {}
    virtual ~Uart() {}
    virtual int Write(unsigned char* /*data*/, int /*size*/) { return API_NOT_SUPPORTED; }
    virtual int Read(unsigned char* /*data*/, int /*size*/) { return API_NOT_SUPPORTED; }
};

#endif
