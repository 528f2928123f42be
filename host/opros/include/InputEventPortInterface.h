// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTEVENTPORTINTERFACE_H_
#define INPUTEVENTPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <Component.h>
#include <EventPort.h>

class EventCallBack;

/// Hands each event to its owner: a callback if there is one, else a component. No queue.
class InputEventPortInterface : public EventPort {
  public:
    InputEventPortInterface();
    explicit InputEventPortInterface(const std::string& name);
    virtual ~InputEventPortInterface();

    virtual EventPortRole getRole();
    virtual void setOwner(Component* owner);
    /// The port deletes the callback.
    virtual void setOwner(EventCallBack* owner);
    virtual void setArchiveFactory(ArchiveFactory* darc);
    virtual void setTopic(const std::string& name);
    virtual std::string getTopic();

    virtual bool checkType(Event* data) = 0;
    virtual bool checkType(EventPort* dst) = 0;
    virtual ReturnType push(Event* data) = 0;
    virtual ReturnType push(opros::archive::iarchive& in) = 0;
    virtual ReturnType pushEvent(unsigned char* data, int size) = 0;

  protected:
    virtual ReturnType push_event(Event* data);

    ArchiveFactory* m_arc;

  private:
    InputEventPortInterface(const InputEventPortInterface&);
    InputEventPortInterface& operator=(const InputEventPortInterface&);
    Component* m_owner;
    EventCallBack* m_callback;
    std::string m_topic;
};

#endif
