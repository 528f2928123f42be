// SPDX-License-Identifier: Apache-2.0
// The connection protocol: connect -> notify_connect along the ports of the profile, and back.
#include "host/rtm/runtime/component/local_object.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "host/rtm/runtime/port/custom_serializer.hpp"
#include <coil/stringutil.h>
#include <rtm/PortBase.h>

namespace RTC {
namespace {

struct PortDescription {
    std::string name, kind, data_type;
};

PortDescription describe_port(PortService_ptr port) {
    PortProfile_var profile = port->get_port_profile();
    return {static_cast<const char*>(profile->name), NVUtil::toString(profile->properties, "port.port_type"),
            NVUtil::toString(profile->properties, "dataport.data_type")};
}

// Why two ports can never be joined; empty when they may.
std::string incompatibility(const PortDescription& a, const PortDescription& b,
                            const ConnectorProfile& profile) {
    const bool services = a.kind == "CorbaPort" && b.kind == "CorbaPort";
    const bool data = (a.kind == "DataInPort" && b.kind == "DataOutPort") ||
                      (a.kind == "DataOutPort" && b.kind == "DataInPort");
    if (!services && !data && !a.kind.empty() && !b.kind.empty())
        return a.name + " is a " + a.kind + ", " + b.name + " is a " + b.kind + ": they cannot be connected";
    if (data && a.data_type != b.data_type && coil::toLower(a.data_type) != "any" &&
        coil::toLower(b.data_type) != "any" && !uses_custom_serializer(profile))
        return a.name + " carries " + a.data_type + ", " + b.name + " carries " + b.data_type +
               ": connect ports of one type";
    return "";
}

std::string incompatibility(const ConnectorProfile& profile) {
    const PortServiceList& ports = profile.ports;
    if (ports.length() < 2) return "";
    const PortDescription first = describe_port(ports[0]);
    for (CORBA::ULong i = 1; i < ports.length(); ++i) {
        std::string reason = incompatibility(first, describe_port(ports[i]), profile);
        if (!reason.empty()) return reason;
    }
    return "";
}

bool has_remote_port(const ConnectorProfile& profile) {
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i)
        if (local_object<PortBase>(profile.ports[i]) == nullptr) return true;
    return false;
}

// Who is told of the end of a connection may be the reason for it.
void set_disconnect_timeout(PortService_ptr port) {
    const auto bound = Manager::instance().impl().connection_keeper->disconnect_timeout();
    omniORB::setClientCallTimeout(port, static_cast<CORBA::ULong>(bound.count()));
}

} // namespace

ReturnCode_t PortBase::connect(ConnectorProfile& profile) {
    if (profile.ports.length() == 0) return refuse(BAD_PARAMETER, "a connection without ports");
    if (isEmptyId(profile))
        setUUID(profile);
    else if (isExistingConnId(profile.connector_id))
        return refuse(PRECONDITION_NOT_MET, std::string("there is a connection with id ") +
                                                static_cast<const char*>(profile.connector_id));
    try {
        const std::string reason = incompatibility(profile);
        if (!reason.empty()) return refuse(BAD_PARAMETER, reason);
        auto first = local_object<PortBase>(profile.ports[0]);
        const ReturnCode_t result =
            first ? first->notify_connect(profile) : profile.ports[0]->notify_connect(profile);
        if (result == RTC_OK) return clearConnectError();
        if (first && first.get() != this) refuse(result, first->connectError());
        const std::string id(profile.connector_id);
        const std::string reason = connectError();
        disconnect(id.c_str()); // whatever part of it was established
        return refuse(result, reason.empty() ? "the other side has refused the connection" : reason);
    } catch (const CORBA::SystemException& e) {
        releaseConnection(profile.connector_id);
        return refuse(RTC_ERROR, "a port of the connection cannot be reached: " + describe_exception(e));
    }
}

ReturnCode_t PortBase::notify_connect(ConnectorProfile& profile) {
    const ReturnCode_t result = establishConnection(profile);
    if (result == RTC_OK && m_onConnected != nullptr) (*m_onConnected)(profile);
    notifyListeners(PortConnectRetListenerType::ON_CONNECTED, profile, result);
    return result;
}

void PortBase::notifyListeners(PortConnectListenerType type, ConnectorProfile& profile) {
    auto call = [&](auto& listener) { listener(getName(), profile); };
    m_connectListeners.at(type).forEach(call);
    if (m_componentConnectListeners != nullptr) m_componentConnectListeners->at(type).forEach(call);
}
void PortBase::notifyListeners(PortConnectRetListenerType type, ConnectorProfile& profile,
                               ReturnCode_t result) {
    auto call = [&](auto& listener) { listener(getName(), profile, result); };
    m_connectListeners.at(type).forEach(call);
    if (m_componentConnectListeners != nullptr) m_componentConnectListeners->at(type).forEach(call);
}

ReturnCode_t PortBase::establishConnection(ConnectorProfile& profile) {
    // Twice would be a circle: each passes the call on to the next one.
    const auto occurrences = occurrencesIn(profile);
    if (occurrences != 1)
        return refuse(BAD_PARAMETER, std::string(getName()) + " is " + std::to_string(occurrences) +
                                         " times in the list of ports to connect, expected once");
    const coil::Properties properties = NVUtil::toProperties(profile.properties);
    const bool duplicates =
        coil::toBool(properties.getProperty("dataport.allow_dup_connection",
                                            m_properties.getProperty("allow_dup_connection")),
                     "YES", "NO", false);
    if (!duplicates && isAlreadyConnected(profile))
        return refuse(PRECONDITION_NOT_MET, std::string(getName()) + " is already connected to that port");
    clearConnectError();

    using Step = PortConnectRetListenerType;
    notifyListeners(PortConnectListenerType::ON_NOTIFY_CONNECT, profile);
    const ReturnCode_t published = publishInterfaces(profile);
    notifyListeners(Step::ON_PUBLISH_INTERFACES, profile, published);
    if (m_onPublishInterfaces != nullptr) (*m_onPublishInterfaces)(profile);
    const ReturnCode_t notified = published == RTC_OK ? notifyNextPort(profile) : published;
    notifyListeners(Step::ON_CONNECT_NEXTPORT, profile, notified);
    if (m_onSubscribeInterfaces != nullptr) (*m_onSubscribeInterfaces)(profile);
    const ReturnCode_t subscribed = notified == RTC_OK ? subscribeInterfaces(profile) : notified;
    notifyListeners(Step::ON_SUBSCRIBE_INTERFACES, profile, subscribed);
    // Kept even when it has failed later: the disconnection that follows finds by it what to undo.
    if (published == RTC_OK) updateConnectorProfile(profile);
    if (subscribed == RTC_OK && has_remote_port(profile)) Manager::instance().impl().connection_keeper->start();
    return subscribed;
}

// A peer that dies or hangs in its notify_connect() leaves us with half a connection, which connect() takes
// back.
ReturnCode_t PortBase::notifyNextPort(ConnectorProfile& profile) {
    try {
        return connectNext(profile);
    } catch (const CORBA::SystemException& e) {
        return refuse(RTC_ERROR, std::string(getName()) + ": the next port of the connection: " + describe_exception(e));
    }
}

ReturnCode_t PortBase::_publishInterfaces() {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    if (m_connectionLimit < 0 ||
        m_profile.connector_profiles.length() < static_cast<CORBA::ULong>(m_connectionLimit))
        return RTC_OK;
    return refuse(RTC_ERROR, std::string(static_cast<const char*>(m_profile.name)) + " has its limit of " +
                                 std::to_string(m_connectionLimit) + " connections");
}

bool PortBase::isAlreadyConnected(const ConnectorProfile& profile) {
    ConnectorProfileList_var present = get_connector_profiles();
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        if (m_objref->_is_equivalent(profile.ports[i])) continue;
        for (CORBA::ULong c = 0; c < present->length(); ++c)
            for (CORBA::ULong p = 0; p < present[c].ports.length(); ++p)
                if (present[c].ports[p]->_is_equivalent(profile.ports[i])) return true;
    }
    return false;
}

CORBA::ULong PortBase::occurrencesIn(const ConnectorProfile& profile) const {
    CORBA::ULong occurrences = 0;
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i)
        if (m_objref->_is_equivalent(profile.ports[i])) ++occurrences;
    return occurrences;
}

ReturnCode_t PortBase::connectNext(ConnectorProfile& profile) {
    const CORBA::Long me =
        CORBA_SeqUtil::find(profile.ports, [this](PortService_ptr p) { return m_objref->_is_equivalent(p); });
    const CORBA::ULong next = static_cast<CORBA::ULong>(me) + 1;
    if (next >= profile.ports.length()) return RTC_OK;
    PortService_var port = RTC::PortService::_duplicate(profile.ports[next]);
    auto local = local_object<PortBase>(port.in());
    const ReturnCode_t result = local ? local->notify_connect(profile) : port->notify_connect(profile);
    return result == RTC_OK || !local ? result : refuse(result, local->connectError());
}

ReturnCode_t PortBase::disconnect(const char* connector_id) {
    const ConnectorProfile profile = findConnProfile(connector_id);
    if (profile.ports.length() == 0)
        return refuse(BAD_PARAMETER, std::string(getName()) + " has no connection with id " + connector_id);
    ReturnCode_t result = RTC_ERROR;
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        try {
            auto local = local_object<PortBase>(profile.ports[i]);
            if (local == nullptr) set_disconnect_timeout(profile.ports[i]);
            result = local ? local->notify_disconnect(connector_id)
                           : profile.ports[i]->notify_disconnect(connector_id);
            break;
        } catch (const CORBA::SystemException& e) {
            RTC_WARN(("disconnecting %s: a peer: %s", getName(), describe_exception(e).c_str()));
        }
    }
    if (releaseConnection(connector_id)) result = RTC_OK; // the peers have not passed it on to us
    return result;
}

ReturnCode_t PortBase::notify_disconnect(const char* connector_id) {
    ConnectorProfile profile = findConnProfile(connector_id);
    if (profile.ports.length() == 0)
        return refuse(BAD_PARAMETER, std::string(getName()) + " has no connection with id " + connector_id);
    notifyListeners(PortConnectListenerType::ON_NOTIFY_DISCONNECT, profile);
    const ReturnCode_t result = disconnectNext(profile);
    notifyListeners(PortConnectRetListenerType::ON_DISCONNECT_NEXT, profile, result);
    releaseConnection(connector_id);
    return result;
}

bool PortBase::releaseConnection(const char* connector_id) {
    ConnectorProfile profile = findConnProfile(connector_id);
    if (profile.ports.length() == 0) return false;
    if (m_onUnsubscribeInterfaces != nullptr) (*m_onUnsubscribeInterfaces)(profile);
    notifyListeners(PortConnectListenerType::ON_UNSUBSCRIBE_INTERFACES, profile);
    unsubscribeInterfaces(profile);
    notifyListeners(PortConnectRetListenerType::ON_DISCONNECTED, profile, RTC_OK);
    if (m_onDisconnected != nullptr) (*m_onDisconnected)(profile);
    return eraseConnectorProfile(connector_id);
}

void PortBase::dropLostConnection(const char* connector_id) {
    ConnectorProfile profile = findConnProfile(connector_id);
    if (profile.ports.length() == 0) return;
    RTC_WARN(("%s: the other side of connection %s is gone", getName(), connector_id));
    if (m_onConnectionLost != nullptr) (*m_onConnectionLost)(profile);
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i)
        if (auto local = local_object<PortBase>(profile.ports[i])) local->releaseConnection(connector_id);
    Manager::instance().impl().connection_keeper->report_lost(profile);
}

ReturnCode_t PortBase::disconnectNext(ConnectorProfile& profile) {
    const CORBA::Long me =
        CORBA_SeqUtil::find(profile.ports, [this](PortService_ptr p) { return m_objref->_is_equivalent(p); });
    if (me < 0) return BAD_PARAMETER;
    for (CORBA::ULong next = static_cast<CORBA::ULong>(me) + 1; next < profile.ports.length(); ++next) {
        try {
            auto local = local_object<PortBase>(profile.ports[next]);
            if (local == nullptr) set_disconnect_timeout(profile.ports[next]);
            return local ? local->notify_disconnect(profile.connector_id)
                         : profile.ports[next]->notify_disconnect(profile.connector_id);
        } catch (const CORBA::SystemException& e) {
            RTC_WARN(("disconnecting %s: a peer: %s", getName(), describe_exception(e).c_str()));
        }
    }
    return RTC_OK;
}

ReturnCode_t PortBase::disconnect_all() {
    ConnectorProfileList_var profiles = get_connector_profiles();
    ReturnCode_t result = RTC_OK;
    for (CORBA::ULong i = 0; i < profiles->length(); ++i) {
        const ReturnCode_t one = disconnect(profiles[i].connector_id);
        if (one != RTC_OK) result = one;
    }
    return result;
}

} // namespace RTC
