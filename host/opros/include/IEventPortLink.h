// SPDX-License-Identifier: Apache-2.0
#ifndef IEVENTPORTLINK_H_
#define IEVENTPORTLINK_H_

#include <Event.h>
#include <EventPort.h>
#include <RemoteEventPort.h>

/// A connection from an output event port to input event ports. The host creates it; components do not call it. A
/// function that an implementation does not need returns OPROS_UNSUPPORTED_METHOD.
class IEventPortLink {
  public:
    virtual ~IEventPortLink() {}
    /// Delivers a clone. Returns OPROS_OUT_OF_RESOURCES, and the event is lost, if too many events wait at the
    /// receiver. [any-thread]
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
