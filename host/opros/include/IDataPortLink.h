// SPDX-License-Identifier: Apache-2.0
#ifndef IDATAPORTLINK_H_
#define IDATAPORTLINK_H_

#include <DataPort.h>
#include <OPRoSTypes.h>
#include <RemoteDataPort.h>

/// A connection from an output data port to input data ports. The host creates it; components do not call it. A
/// function that an implementation does not need returns OPROS_UNSUPPORTED_METHOD.
class IDataPortLink {
  public:
    virtual ~IDataPortLink() {}
    /// Delivers the value in this thread before it returns. [any-thread]
    virtual ReturnType push(opros_any& data) = 0;
    virtual ReturnType setSource(DataPort* src) = 0;
    virtual ReturnType addDestination(DataPort* dest) = 0;
    virtual ReturnType addDestination(RemoteDataPort* dest) = 0;
    virtual ReturnType removeDestination(DataPort* dest) = 0;
    virtual ReturnType removeDestination(RemoteDataPort* dest) = 0;
    virtual ReturnType clearDestination() = 0;
    virtual ReturnType clearSource() = 0;
};

#endif
