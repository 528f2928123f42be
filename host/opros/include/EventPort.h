// SPDX-License-Identifier: Apache-2.0
#ifndef EVENTPORT_H_
#define EVENTPORT_H_

#include <Event.h>
#include <OPRoSTypes.h>
#include <Port.h>
#include <ReturnType.h>

#ifndef EVENT_OPROS
#define EVENT_OPROS 0
#endif

/// What input and output event ports have in common. [any-thread] push and the checks of types.
class EventPort : public Port {
  public:
    EventPort();
    explicit EventPort(const std::string& name);
    virtual ~EventPort();

    /// Output: sends a clone to each connected input. Input: calls the owner, in this thread. The event stays the
    /// caller's. OPROS_BAD_INPUT_PARAMETER: NULL, or another type of content than the port's.
    virtual ReturnType push(Event* data) = 0;
    /// Whether the event's content is of the port's type.
    virtual bool checkType(Event* data) = 0;
    /// Whether this port may be connected to that one.
    virtual bool checkType(EventPort* dst) = 0;
    virtual EventPortRole getRole() = 0;
    /// push() of an encoded event of `size` bytes. OPROS_UNSUPPORTED_METHOD: the port has no archive factory, or its
    /// type cannot be archived.
    virtual ReturnType pushEvent(unsigned char* data, int size) = 0;
    virtual void reset() {}
};

#endif
