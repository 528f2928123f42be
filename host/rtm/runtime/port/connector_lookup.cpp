// SPDX-License-Identifier: Apache-2.0
// The functions of InPortBase and OutPortBase that find connectors and add listeners. Both are public classes of
// OpenRTM-aist without a common base for data ports, so one macro defines the functions for each.
#include "host/rtm/runtime/transport/in_port_connectors.hpp"
#include <rtm/InPortBase.h>
#include <rtm/OutPortBase.h>

namespace RTC {
namespace {

/// Applies `get` to each connector, with the mutex held. The list holds copies, which stay valid when a
/// connection ends.
template <class Connectors, class Get>
auto collect(std::mutex& mutex, Connectors& connectors, Get get) {
    std::lock_guard<std::mutex> lock(mutex);
    std::vector<std::decay_t<decltype(get(*connectors.front()))>> all;
    all.reserve(connectors.size());
    for (auto* connector : connectors) all.push_back(get(*connector));
    return all;
}

/// Returns NULL if no connector matches. As in OpenRTM-aist, nothing protects the connector after the lock is released.
template <class Connectors, class Matches>
auto first_of(std::mutex& mutex, Connectors& connectors, Matches matches) -> typename Connectors::value_type {
    std::lock_guard<std::mutex> lock(mutex);
    for (auto* connector : connectors)
        if (matches(*connector)) return connector;
    return nullptr;
}

bool copy_profile(ConnectorBase* connector, ConnectorInfo& out) {
    if (connector == nullptr) return false;
    out = connector->profile();
    return true;
}

// Once there is a listener, code that looks at the port no longer receives messages from a ring. See
// PushReceiver::try_receive_from_ring().
void receive_from_rings(std::mutex& mutex, InPortBase::ConnectorList& connectors) {
    const auto receivers = collect(mutex, connectors, [](InPortConnector& connector) {
        auto* const push = dynamic_cast<InPortPushConnector*>(&connector);
        return push != nullptr ? push->receiver() : nullptr;
    });
    for (const auto& receiver : receivers)
        if (receiver != nullptr) receiver->receive_from_ring();
}
void receive_from_rings(std::mutex&, OutPortBase::ConnectorList&) {}

} // namespace

const char* toString(DataPortStatus status) {
    static const char* const names[] = {"PORT_OK",         "PORT_ERROR",   "BUFFER_ERROR",
                                        "BUFFER_FULL",     "BUFFER_EMPTY", "BUFFER_TIMEOUT",
                                        "SEND_FULL",       "SEND_TIMEOUT", "RECV_EMPTY",
                                        "RECV_TIMEOUT",    "INVALID_ARGS", "PRECONDITION_NOT_MET",
                                        "CONNECTION_LOST", "UNKNOWN_ERROR"};
    return names[static_cast<std::uint8_t>(status)];
}
const char* DataPortStatus::toString(DataPortStatus status) { return RTC::toString(status); }

#define TANDEM_DATA_PORT_LISTS(Port, Connector)                                                              \
    ConnectorInfoList Port::getConnectorProfiles() {                                                         \
        return collect(m_connectorsMutex, m_connectors,                                                      \
                       [](Connector& c) { return ConnectorInfo(c.profile()); });                             \
    }                                                                                                        \
    coil::vstring Port::getConnectorIds() {                                                                  \
        return collect(m_connectorsMutex, m_connectors, [](Connector& c) { return std::string(c.id()); });   \
    }                                                                                                        \
    coil::vstring Port::getConnectorNames() {                                                                \
        return collect(m_connectorsMutex, m_connectors, [](Connector& c) { return std::string(c.name()); }); \
    }                                                                                                        \
    Connector* Port::getConnectorById(const char* id) {                                                      \
        return first_of(m_connectorsMutex, m_connectors,                                                     \
                        [&](Connector& c) { return std::string(c.id()) == id; });                            \
    }                                                                                                        \
    Connector* Port::getConnectorByName(const char* name) {                                                  \
        return first_of(m_connectorsMutex, m_connectors,                                                     \
                        [&](Connector& c) { return std::string(c.name()) == name; });                        \
    }                                                                                                        \
    bool Port::getConnectorProfileById(const char* id, ConnectorInfo& prof) {                                \
        return copy_profile(getConnectorById(id), prof);                                                     \
    }                                                                                                        \
    bool Port::getConnectorProfileByName(const char* name, ConnectorInfo& prof) {                            \
        return copy_profile(getConnectorByName(name), prof);                                                 \
    }                                                                                                        \
    void Port::addConnectorDataListener(ConnectorDataListenerType type, ConnectorDataListener* listener,     \
                                        bool autoclean) {                                                    \
        m_listeners.addListener(type, listener, autoclean);                                                  \
        receive_from_rings(m_connectorsMutex, m_connectors);                                                 \
    }                                                                                                        \
    void Port::removeConnectorDataListener(ConnectorDataListenerType type,                                   \
                                           ConnectorDataListener* listener) {                                \
        m_listeners.removeListener(type, listener);                                                          \
    }                                                                                                        \
    void Port::addConnectorListener(ConnectorListenerType type, ConnectorListener* listener,                 \
                                    bool autoclean) {                                                        \
        m_listeners.addListener(type, listener, autoclean);                                                  \
    }                                                                                                        \
    void Port::removeConnectorListener(ConnectorListenerType type, ConnectorListener* listener) {            \
        m_listeners.removeListener(type, listener);                                                          \
    }

TANDEM_DATA_PORT_LISTS(InPortBase, InPortConnector)
TANDEM_DATA_PORT_LISTS(OutPortBase, OutPortConnector)

} // namespace RTC
