// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTEVENTPORTINTERFACE_H_
#define INPUTEVENTPORTINTERFACE_H_

#include <ArchiveFactory.h>
#include <Component.h>
#include <EventPort.h>

class EventCallBack;

/// Hands each event to its owner in the pushing thread: to a callback if there is one, otherwise to a component's
/// onEvent(). The port has no queue; the host delivers events of other components from a queue of the receiving
/// component. Set owner and topic before events arrive.
class InputEventPortInterface : public EventPort {
  public:
    InputEventPortInterface();
    explicit InputEventPortInterface(const std::string& name);
    virtual ~InputEventPortInterface();

    virtual EventPortRole getRole();
    /// Sets the component whose onEvent() is called. It must outlive the port, which is usually its member.
    virtual void setOwner(Component* owner);
    /// Sets the callback and takes ownership of it.
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
    /// Implements push() of derived ports. Returns OPROS_CALLER_ERROR if the port has no owner.
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
