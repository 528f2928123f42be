// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_CAN_H_
#define DEVICE_CAN_H_

#include "Bus.h"

/// A CAN bus. Read and Write transfer one frame of at most `size` bytes. `id` is the frame's id.
class Can : public Bus {
  public:
    Can() {}
    virtual ~Can() {}
    virtual int Write(long /*id*/, unsigned char* /*data*/, int /*size*/) { return API_NOT_SUPPORTED; }
    virtual int Read(long& /*id*/, unsigned char* /*data*/, int /*size*/) { return API_NOT_SUPPORTED; }
};

#endif
