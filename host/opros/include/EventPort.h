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

/// What input and output event ports have in common.
class EventPort : public Port {
  public:
    EventPort();
    explicit EventPort(const std::string& name);
    virtual ~EventPort();

    virtual ReturnType push(Event* data) = 0;
    virtual bool checkType(Event* data) = 0;
    virtual bool checkType(EventPort* dst) = 0;
    virtual EventPortRole getRole() = 0;
    virtual ReturnType pushEvent(unsigned char* data, int size) = 0;
    virtual void reset() {}
};

#endif
