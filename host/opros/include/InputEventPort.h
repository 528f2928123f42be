// SPDX-License-Identifier: Apache-2.0
#ifndef INPUTEVENTPORT_H_
#define INPUTEVENTPORT_H_

#include <Component.h>
#include <EventCodec.h>
#include <EventData.h>
#include <InputEventPortInterface.h>

/// An input event port for events whose content is a dataType. The component calls setOwner(this) or sets a callback
/// (EventCallBack.h), and adds the port. Upstream uses the second argument for other kinds of event sources, which do
/// not exist here.
template <typename dataType, int ModType = EVENT_OPROS>
class InputEventPort {};

template <typename dataType>
class InputEventPort<dataType, EVENT_OPROS> : public InputEventPortInterface {
  public:
    InputEventPort() {}
    InputEventPort(const std::string& name) : InputEventPortInterface(name) {}

    virtual bool checkType(EventPort* dst) {
        EventData<dataType> event;
        return dst && dst->checkType(&event);
    }
    virtual bool checkType(Event* data) {
        opros_any content = sample();
        return data && data->checkContentType(content);
    }
    virtual ReturnType push(Event* data) { return data ? push_event(data) : OPROS_BAD_INPUT_PARAMETER; }
    /// Decodes an event from the archive and pushes it. Exceptions of the archive pass through.
    virtual ReturnType push(opros::archive::iarchive& in) {
        return opros::detail::event_codec<dataType>::push(*this, in);
    }
    virtual ReturnType pushEvent(unsigned char* data, int size) {
        return opros::detail::push_encoded(*this, m_arc, data, size);
    }
    virtual opros_any sample() const { return opros_any(dataType()); }
};

#endif
