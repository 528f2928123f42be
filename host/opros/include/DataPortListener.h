// SPDX-License-Identifier: Apache-2.0
// Ours, for the host.
#ifndef DATAPORTLISTENER_H_
#define DATAPORTLISTENER_H_

/// Is told of each value that comes into an input data port, in the thread that pushes it; must not block.
class DataPortListener {
  public:
    virtual ~DataPortListener() {}
    virtual void arrived() = 0;
};

#endif
