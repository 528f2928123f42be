// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTEVENTPORTINTERFACE_H_
#define INPUTEVENTPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <Component.h>
#include <EventPort.h>

class EventCallBack;

/// Hands each event to its owner, in the thread that pushes it: to a callback if there is one, else to a component's
/// onEvent(). It has no queue; the host delivers the events of other components from a queue of the receiving
/// component. The owner and topic belong before events arrive.
class InputEventPortInterface : public EventPort {
  public:
    InputEventPortInterface();
    explicit InputEventPortInterface(const std::string& name);
    virtual ~InputEventPortInterface();

    virtual EventPortRole getRole();
    /// The component whose onEvent() is called; it must outlive the port, of which it usually is the owner in C++, too.
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
    /// What push() of a derived port does. OPROS_CALLER_ERROR: the port has no owner.
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
