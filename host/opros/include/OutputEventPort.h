// SPDX-License-Identifier: Apache-2.0
#ifndef OUTPUTEVENTPORT_H_
#define OUTPUTEVENTPORT_H_

#include <EventCodec.h>
#include <EventData.h>
#include <OutputEventPortInterface.h>

/// An output event port for events whose content is a dataType: a member of the component, added with addPort(). push()
/// returns at once; receivers handle their copies in their threads. Upstream uses the second argument for other kinds
/// of event sources, which do not exist here. [any-thread] push
template <typename dataType, int ModType = EVENT_OPROS>
class OutputEventPort {};

template <typename dataType>
class OutputEventPort<dataType, EVENT_OPROS> : public OutputEventPortInterface {
  public:
    OutputEventPort() {}
    OutputEventPort(const std::string& name) : OutputEventPortInterface(name) {}

    virtual bool checkType(EventPort* dst) {
        EventData<dataType> event;
        return dst && dst->checkType(&event);
    }
    virtual bool checkType(Event* data) {
        opros_any content = sample();
        return data && data->checkContentType(content);
    }
    /// Sends an event with this content and the id "event".
    virtual ReturnType push(const dataType& data) {
        EventData<dataType> event;
        event.setContentData(data);
        return push_event(&event);
    }
    virtual ReturnType push(Event* data) { return data ? push_event(data) : OPROS_BAD_INPUT_PARAMETER; }
    /// Decodes an event from the archive and sends it. Exceptions of the archive pass through.
    virtual ReturnType push(opros::archive::iarchive& in) {
        return opros::detail::event_codec<dataType>::push(*this, in);
    }
    virtual ReturnType pushEvent(unsigned char* data, int size) {
        return opros::detail::push_encoded(*this, m_arc, data, size);
    }
    virtual ReturnType marshal(Event* data, std::string& outdata) {
        if (!m_arc) return OPROS_UNSUPPORTED_METHOD;
        return opros::detail::event_codec<dataType>::marshal(*m_arc, data, outdata);
    }
    virtual opros_any sample() const { return opros_any(dataType()); }
};

#endif
