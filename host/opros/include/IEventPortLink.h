// SPDX-License-Identifier: Apache-2.0
#ifndef IEVENTPORTLINK_H_
#define IEVENTPORTLINK_H_

#include <Event.h>
#include <EventPort.h>
#include <RemoteEventPort.h>

/// From one output event port to any number of input event ports: made by the host.
class IEventPortLink {
  public:
    virtual ~IEventPortLink() {}
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
