// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_SOCKET_H_
#define DEVICE_SOCKET_H_

#include "Bus.h"

/// A network connection. Read and Write transfer at most `size` bytes.
class Socket : public Bus {
  public:
    Socket() {}
    virtual ~Socket() {}
    virtual int Write(unsigned char* /*data*/, int /*size*/) { return API_NOT_SUPPORTED; }
    virtual int Read(unsigned char* /*data*/, int /*size*/) { return API_NOT_SUPPORTED; }
};

#endif
