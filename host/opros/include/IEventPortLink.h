// SPDX-License-Identifier: Apache-2.0
#ifndef IEVENTPORTLINK_H_
#define IEVENTPORTLINK_H_

#include <Event.h>
#include <EventPort.h>
#include <RemoteEventPort.h>

/// A connection from an output event port to input event ports, made by the host: components do not call it. A
/// function that an implementation does not need returns OPROS_UNSUPPORTED_METHOD.
class IEventPortLink {
  public:
    virtual ~IEventPortLink() {}
    /// [any-thread] Delivers a clone; OPROS_OUT_OF_RESOURCES: too many wait at the receiver, it is lost.
    virtual ReturnType push(Event* data) = 0;
    virtual ReturnType setSource(EventPort* src) = 0;
    virtual ReturnType addDestination(EventPort* dest) = 0;
    virtual ReturnType removeDestination(EventPort* dest) = 0;
    virtual ReturnType addDestination(RemoteEventPort* dest) = 0;
    virtual ReturnType removeDestination(RemoteEventPort* dest) = 0;
    virtual ReturnType clearDestination() = 0;
    virtual ReturnType clearSource() = 0;
};

#endif
