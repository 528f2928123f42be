// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/port/connection_list.hpp"

#include <EventCallBack.h>
#include <InputEventPortInterface.h>
#include <OutputEventPortInterface.h>

// The public header names this class, because it cannot include opros::ConnectionList.
class OutputEventPortImpl : public opros::ConnectionList<IEventPortLink> {
  public:
    std::string topic;
};

InputEventPortInterface::InputEventPortInterface() : InputEventPortInterface("") {}
InputEventPortInterface::InputEventPortInterface(const std::string& name)
    : EventPort(name), m_arc(nullptr), m_owner(nullptr), m_callback(nullptr) {}
InputEventPortInterface::~InputEventPortInterface() { delete m_callback; }

EventPortRole InputEventPortInterface::getRole() { return OPROS_EVENT_PORT_INPUT; }
void InputEventPortInterface::setOwner(Component* owner) { m_owner = owner; }
void InputEventPortInterface::setOwner(EventCallBack* owner) {
    // A component may set the same callback again. Do not delete it then.
    if (owner != m_callback) delete m_callback;
    m_callback = owner;
}
void InputEventPortInterface::setArchiveFactory(ArchiveFactory* darc) { m_arc = darc; }
void InputEventPortInterface::setTopic(const std::string& name) { m_topic = name; }
std::string InputEventPortInterface::getTopic() { return m_topic; }

// Runs in the caller's thread. For an event from another component, the caller is the receiver's task queue.
ReturnType InputEventPortInterface::push_event(Event* data) {
    if (!checkType(data)) return OPROS_BAD_INPUT_PARAMETER;
    if (m_callback) return m_callback->onEvent(data);
    return m_owner ? m_owner->onEvent(data) : OPROS_CALLER_ERROR;
}

OutputEventPortInterface::OutputEventPortInterface() : OutputEventPortInterface("") {}
OutputEventPortInterface::OutputEventPortInterface(const std::string& name)
    : EventPort(name), m_impl(new OutputEventPortImpl), m_arc(nullptr) {}
OutputEventPortInterface::~OutputEventPortInterface() { delete m_impl; }

EventPortRole OutputEventPortInterface::getRole() { return OPROS_EVENT_PORT_OUTPUT; }
void OutputEventPortInterface::setArchiveFactory(ArchiveFactory* darc) { m_arc = darc; }
void OutputEventPortInterface::addConnection(IEventPortLink* connection) { m_impl->add(connection); }
void OutputEventPortInterface::removeConnection(IEventPortLink* connection) { m_impl->remove(connection); }
void OutputEventPortInterface::clearConnection() { m_impl->clear(); }
void OutputEventPortInterface::setTopic(const std::string& name) { m_impl->topic = name; }
std::string OutputEventPortInterface::getTopic() { return m_impl->topic; }

// Pushes to all connections. Returns the last failure.
ReturnType OutputEventPortInterface::push_event(Event* data) {
    if (!checkType(data)) return OPROS_BAD_INPUT_PARAMETER;
    ReturnType result = OPROS_SUCCESS;
    m_impl->for_each([&](IEventPortLink& link) {
        if (const ReturnType pushed = link.push(data); pushed != OPROS_SUCCESS) result = pushed;
    });
    return result;
}
