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

/// Base class of input and output event ports. [any-thread] push and the checks of types.
class EventPort : public Port {
  public:
    EventPort();
    explicit EventPort(const std::string& name);
    virtual ~EventPort();

    /// Output: sends a clone to each connected input. Input: calls the owner in this thread. The event remains the
    /// caller's. Returns OPROS_BAD_INPUT_PARAMETER for NULL or if the content is not of the port's type.
    virtual ReturnType push(Event* data) = 0;
    /// Returns true if the event's content is of the port's type.
    virtual bool checkType(Event* data) = 0;
    /// Returns true if this port may be connected to `dst`.
    virtual bool checkType(EventPort* dst) = 0;
    virtual EventPortRole getRole() = 0;
    /// Pushes an encoded event of `size` bytes. Returns OPROS_UNSUPPORTED_METHOD if the port has no archive factory
    /// or its type cannot be archived.
    virtual ReturnType pushEvent(unsigned char* data, int size) = 0;
    virtual void reset() {}
};

#endif
