// SPDX-License-Identifier: Apache-2.0
#ifndef REMOTEDATAPORT_H_
#define REMOTEDATAPORT_H_

#include <ReturnType.h>

/// An input data port of another node, for upstream's distribution. This host does not support it.
class RemoteDataPort {
  public:
    virtual ~RemoteDataPort() {}
    virtual ReturnType pushData(unsigned char* data, int size) = 0;
};

#endif
