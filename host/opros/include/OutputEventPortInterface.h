// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTEVENTPORTINTERFACE_H_
#define OUTPUTEVENTPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <EventPort.h>
#include <IEventPortLink.h>

class OutputEventPortImpl;

/// An output event port with any type of content. Hands each event to its connections, which deliver copies. Pushes of
/// several threads are delivered one after the other. [any-thread] push
class OutputEventPortInterface : public EventPort {
  public:
    OutputEventPortInterface();
    explicit OutputEventPortInterface(const std::string& name);
    virtual ~OutputEventPortInterface();

    virtual ReturnType push(Event* data) = 0;
    virtual ReturnType pushEvent(unsigned char* data, int size) = 0;
    /// Encodes the event with the port's archive factory. Returns OPROS_UNSUPPORTED_METHOD if there is no factory or
    /// the type cannot be archived.
    virtual ReturnType marshal(Event* data, std::string& outdata) = 0;
    virtual bool checkType(Event* data) = 0;
    virtual bool checkType(EventPort* dst) = 0;
    virtual EventPortRole getRole();
    virtual void setArchiveFactory(ArchiveFactory* darc);
    /// For the host: adds a connection, which remains the caller's and must be removed before it is deleted. On
    /// return from removeConnection() no push uses it. Must not be called from within a push.
    virtual void addConnection(IEventPortLink* connection);
    virtual void removeConnection(IEventPortLink* connection);
    virtual void clearConnection();
    virtual void setTopic(const std::string& name);
    virtual std::string getTopic();

  protected:
    /// Implements push() of derived ports: checks the type and delivers to all connections. Returns
    /// OPROS_OUT_OF_RESOURCES if too many events wait at one of the receivers, which does not get this one.
    virtual ReturnType push_event(Event* data);

    OutputEventPortImpl* m_impl;
    ArchiveFactory* m_arc;

  private:
    OutputEventPortInterface(const OutputEventPortInterface&);
    OutputEventPortInterface& operator=(const OutputEventPortInterface&);
};

#endif
