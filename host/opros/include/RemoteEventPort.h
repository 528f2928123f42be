// SPDX-License-Identifier: Apache-2.0
#ifndef REMOTEEVENTPORT_H_
#define REMOTEEVENTPORT_H_

#include <ReturnType.h>

/// An input event port of another node, for upstream's distribution. This host does not support it.
class RemoteEventPort {
  public:
    virtual ~RemoteEventPort() {}
    virtual ReturnType pushEvent(unsigned char* data, int size) = 0;
};

#endif
