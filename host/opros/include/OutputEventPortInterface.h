// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTEVENTPORTINTERFACE_H_
#define OUTPUTEVENTPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <EventPort.h>
#include <IEventPortLink.h>

class OutputEventPortImpl;

/// An output event port, of whatever type of content: hands each event to its connections, which deliver copies of it.
/// [any-thread] push; pushes of several threads go out one after the other.
class OutputEventPortInterface : public EventPort {
  public:
    OutputEventPortInterface();
    explicit OutputEventPortInterface(const std::string& name);
    virtual ~OutputEventPortInterface();

    virtual ReturnType push(Event* data) = 0;
    virtual ReturnType pushEvent(unsigned char* data, int size) = 0;
    /// Encodes the event with the port's archive factory. OPROS_UNSUPPORTED_METHOD: there is none, or the type
    /// cannot be archived.
    virtual ReturnType marshal(Event* data, std::string& outdata) = 0;
    virtual bool checkType(Event* data) = 0;
    virtual bool checkType(EventPort* dst) = 0;
    virtual EventPortRole getRole();
    virtual void setArchiveFactory(ArchiveFactory* darc);
    /// For the host. The connection stays the caller's and must be removed before it is deleted; on return of
    /// removeConnection() no push is in it. Not from within a push.
    virtual void addConnection(IEventPortLink* connection);
    virtual void removeConnection(IEventPortLink* connection);
    virtual void clearConnection();
    virtual void setTopic(const std::string& name);
    virtual std::string getTopic();

  protected:
    /// What push() of a derived port does: checks the type and goes through the connections.
    virtual ReturnType push_event(Event* data);

    OutputEventPortImpl* m_impl;
    ArchiveFactory* m_arc;

  private:
    OutputEventPortInterface(const OutputEventPortInterface&);
    OutputEventPortInterface& operator=(const OutputEventPortInterface&);
};

#endif
