// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_EVENTINPORT_H
#define RTC_EVENTINPORT_H
#include <rtm/InPortBase.h>
#include <rtm/PortCallback.h>
#include <rtm/StaticFSM.h>
#include <rtm/Timestamp.h>
#include <rtm/Typename.h>
#include <rtm/idl/BasicDataTypeSkel.h>
#include <string>
#include <type_traits>

namespace RTC {

/// Returns true if the connection carries this event. The connection's property `fsm_event_name`, or its name, names
/// the event.
inline bool carriesEvent(ConnectorInfo& info, const std::string& event_name) {
    return info.properties.getProperty("fsm_event_name") == event_name || info.name == event_name;
}

/// Queues an event without argument for each message of its connection, independent of the message's type.
template <class FSM, class TOP, class R>
class EventBinder0 : public ConnectorDataListener {
  public:
    USE_CONNLISTENER_STATUS;
    EventBinder0(FSM& fsm, const char* event_name, R (TOP::*handler)())
        : m_fsm(fsm), m_eventName(event_name), m_handler(handler) {}
    using ConnectorDataListener::operator();
    ReturnCode operator()(ConnectorInfo& info, ByteData&, const std::string&) override {
        if (!carriesEvent(info, m_eventName)) return NO_CHANGE;
        FSM& fsm = m_fsm;
        auto handler = m_handler;
        m_fsm.getBuffer().put([&fsm, handler] { fsm.dispatch(Macho::Event(handler)); });
        return NO_CHANGE;
    }

  private:
    FSM& m_fsm;
    std::string m_eventName;
    R (TOP::*m_handler)();
};

/// Queues an event whose argument is the received value.
template <class FSM, class TOP, class R, class P0>
class EventBinder1 : public ConnectorDataListenerT<P0> {
  public:
    USE_CONNLISTENER_STATUS;
    EventBinder1(FSM& fsm, const char* event_name, R (TOP::*handler)(P0))
        : m_fsm(fsm), m_eventName(event_name), m_handler(handler) {}
    using ConnectorDataListenerT<P0>::operator();
    // Checked before the bytes are decoded, because messages of other events have other types.
    ReturnCode operator()(ConnectorInfo& info, ByteData& bytes, const std::string& marshalingtype) override {
        if (!carriesEvent(info, m_eventName)) return NO_CHANGE;
        return ConnectorDataListenerT<P0>::operator()(info, bytes, marshalingtype);
    }
    ReturnCode operator()(ConnectorInfo&, P0& data) override {
        FSM& fsm = m_fsm;
        auto handler = m_handler;
        m_fsm.getBuffer().put([&fsm, handler, data] { fsm.dispatch(Macho::Event(handler, data)); });
        return NO_CHANGE;
    }

  private:
    FSM& m_fsm;
    std::string m_eventName;
    R (TOP::*m_handler)(P0);
};

/// Returns the repository id of the type of an event's argument, or an empty string if it has none.
template <class T, bool is_class = std::is_class<T>::value>
struct EventArgument {
    static std::string id() { return CORBA_Util::toRepositoryId<T>(); }
};
template <class T>
struct EventArgument<T, false> {
    static std::string id() { return ""; }
};

/// Applies a connection's properties `buffer.*` to the machine's event queue. The port itself stores no messages.
class EventConnListener : public ConnectorListener {
  public:
    USE_CONNLISTENER_STATUS;
    explicit EventConnListener(FsmEvents& events) : m_events(events) {}
    using ConnectorListener::operator();
    ReturnCode operator()(ConnectorInfo& info) override {
        if (const auto* buffer = info.properties.findNode("buffer")) m_events.init(*buffer);
        return NO_CHANGE;
    }

  private:
    FsmEvents& m_events;
};

/// A data port whose messages are events of a state machine. Accepts any data type. The sender's thread queues the
/// messages; the machine handles them in run_event().
template <class FsmType>
class EventInPort : public InPortBase {
  public:
    EventInPort(const char* name, FsmType& fsm) : InPortBase(name, "any"), m_name(name), m_fsm(fsm) {
        addProperty("dataport.marshaling_types", "cdr");
    }
    virtual const char* name() { return m_name.c_str(); }
    void init(coil::Properties& prop) override {
        InPortBase::init(prop);
        addConnectorListener(ConnectorListenerType::ON_CONNECT, new EventConnListener(m_fsm.getBuffer()));
    }
    template <class TOP, class R, class P0>
    void bindEvent(const char* name, R (TOP::*handler)(P0)) {
        describeEvent(name + ("=" + EventArgument<P0>::id()));
        addConnectorDataListener(ConnectorDataListenerType::ON_RECEIVED,
                                 new EventBinder1<FsmType, TOP, R, P0>(m_fsm, name, handler));
    }
    template <class TOP, class R>
    void bindEvent(const char* name, R (TOP::*handler)()) {
        describeEvent(name);
        addConnectorDataListener(ConnectorDataListenerType::ON_RECEIVED,
                                 new EventBinder0<FsmType, TOP, R>(m_fsm, name, handler));
    }
    bool read(std::string /*name*/ = "") override { return true; }

  private:
    // Ours: the port's profile lists its events, `NAME` or `NAME=TYPE`, since the port's type does not show them.
    void describeEvent(const std::string& event) { appendProperty("dataport.fsm_events", event.c_str()); }

    std::string m_name;
    FsmType& m_fsm;
};

} // namespace RTC
#endif
