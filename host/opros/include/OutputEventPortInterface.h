// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTEVENTPORTINTERFACE_H_
#define OUTPUTEVENTPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <EventPort.h>
#include <IEventPortLink.h>

class OutputEventPortImpl;

/// Hands each event to its links, which deliver copies of it.
class OutputEventPortInterface : public EventPort {
  public:
    OutputEventPortInterface();
    explicit OutputEventPortInterface(const std::string& name);
    virtual ~OutputEventPortInterface();

    virtual ReturnType push(Event* data) = 0;
    virtual ReturnType pushEvent(unsigned char* data, int size) = 0;
    virtual ReturnType marshal(Event* data, std::string& outdata) = 0;
    virtual bool checkType(Event* data) = 0;
    virtual bool checkType(EventPort* dst) = 0;
    virtual EventPortRole getRole();
    virtual void setArchiveFactory(ArchiveFactory* darc);
    virtual void addConnection(IEventPortLink* connection);
    virtual void removeConnection(IEventPortLink* connection);
    virtual void clearConnection();
    virtual void setTopic(const std::string& name);
    virtual std::string getTopic();

  protected:
    virtual ReturnType push_event(Event* data);

    OutputEventPortImpl* m_impl;
    ArchiveFactory* m_arc;

  private:
    OutputEventPortInterface(const OutputEventPortInterface&);
    OutputEventPortInterface& operator=(const OutputEventPortInterface&);
};

#endif
