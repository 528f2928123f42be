// SPDX-License-Identifier: Apache-2.0
// The connection protocol of the OMG RTC specification's introspection services, as OpenRTM-aist does it:
// connect() and disconnect() call the first port of the profile, and each port passes notify_connect() or
// notify_disconnect() on to the next one. Each port on the profile's way adds to it what the port publishes.
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include "host/rtm/runtime/naming/remote_names.hpp"
#include "host/rtm/runtime/port/custom_serializer.hpp"
#include "host/rtm/runtime/port/refusal_reason.hpp"
#include "host/rtm/runtime/port/remote_port.hpp"
#include <coil/stringutil.h>
#include <mutex>
#include <optional>
#include <rtm/PortBase.h>
#include <set>
#include <system_error>

namespace RTC {
namespace {

/// The facts that decide whether two ports can be connected. `kind` is the port.port_type. The properties of a foreign
/// port are empty.
struct PortDescription {
    std::string name, kind, data_type;
};

PortDescription describe_port(const PortProfile& profile) {
    return {static_cast<const char*>(profile.name), NVUtil::toString(profile.properties, "port.port_type"),
            NVUtil::toString(profile.properties, "dataport.data_type")};
}

PortDescription describe_port(PortService_ptr port) {
    if (const auto local = local_object<PortBase>(port))
        return describe_port(local->profileWithoutConnections());
    return describe_port(PortProfile_var(port->get_port_profile()).in());
}

// Returns in one line why two ports cannot be connected; empty if they can. Ports of unknown kind pass, because they
// decide themselves.
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

// Compares each port of a connection with the first one.
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

// Compares `own` with the first port of a connection, if the first port is in another process: a port of OpenRTM-aist
// that is asked to connect compares nothing. A first port that does not answer passes, because the next step then
// fails.
std::string incompatibility_with_remote_first(PortService_ptr own, const ConnectorProfile& profile) {
    PortService_ptr first = profile.ports[0];
    if (local_object<PortBase>(first) != nullptr) return "";
    try {
        return incompatibility(describe_port(own), describe_port(first), profile);
    } catch (const CORBA::SystemException&) {
        return "";
    }
}

bool allows_duplicates(const ConnectorProfile& profile, const coil::Properties& port) {
    return coil::toBool(
        NVUtil::toProperties(profile.properties)
            .getProperty("dataport.allow_dup_connection", port.getProperty("allow_dup_connection")),
        "YES", "NO", false);
}

std::string duplicate_reason(const std::string& port) { return port + " is already connected to that port"; }

// Turns off the duplicate check at all ports of a connection, after the first port that was asked has found no
// duplicate. A port of OpenRTM-aist 2.x looks for duplicates while it holds its lock. If it then finds another
// connection whose peer has died, it waits for that lock forever.
void leave_out_duplicate_check(ConnectorProfile& profile) {
    CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV("dataport.allow_dup_connection", "YES"));
}

// Returns the position of `port` in the list of the profile, or -1.
CORBA::Long position_of(PortService_ptr port, const ConnectorProfile& profile) {
    return CORBA_SeqUtil::find(profile.ports,
                               [port](PortService_ptr other) { return port->_is_equivalent(other); });
}

// Calls a port of this process directly, any other by CORBA.
ReturnCode_t notify_connect_at(PortService_ptr port, ConnectorProfile& profile) {
    const auto local = local_object<PortBase>(port);
    return local ? local->notify_connect(profile) : port->notify_connect(profile);
}

// Calls a port of this process directly and any other by CORBA. CORBA calls have the short time limit of
// disconnections, because a hanging peer may be their reason.
ReturnCode_t notify_disconnect_at(PortService_ptr port, const char* connector_id) {
    if (const auto local = local_object<PortBase>(port)) return local->notify_disconnect(connector_id);
    const auto timeout = Manager::instance().impl().connection_keeper->disconnect_timeout();
    omniORB::setClientCallTimeout(port, static_cast<CORBA::ULong>(timeout.count()));
    return port->notify_disconnect(connector_id);
}

/// While it exists, this process takes part in ending the connection on purpose.
class OrderlyDisconnection {
  public:
    explicit OrderlyDisconnection(const char* connector_id) : id_(connector_id) {
        const std::lock_guard lock(all().mutex);
        all().ids.insert(id_);
    }
    ~OrderlyDisconnection() {
        const std::lock_guard lock(all().mutex);
        all().ids.erase(all().ids.find(id_));
    }
    OrderlyDisconnection(const OrderlyDisconnection&) = delete;
    OrderlyDisconnection& operator=(const OrderlyDisconnection&) = delete;

    static bool includes(const char* connector_id) {
        const std::lock_guard lock(all().mutex);
        return all().ids.contains(connector_id);
    }

  private:
    struct All {
        std::mutex mutex;
        std::multiset<std::string> ids; // once for each port of this process
    };
    // Never deleted: a call to a peer that hangs may outlive static objects.
    static All& all() {
        static auto* const the_ids = new All;
        return *the_ids;
    }

    const std::string id_;
};

// Notifies the first reachable port from position `begin` on, which passes the call on to the ports behind it. Returns
// an empty result if no port is reachable.
std::optional<ReturnCode_t> notify_disconnect_from(CORBA::ULong begin, const ConnectorProfile& profile,
                                                   const Logger& rtclog) {
    for (CORBA::ULong i = begin; i < profile.ports.length(); ++i) {
        try {
            return notify_disconnect_at(profile.ports[i], profile.connector_id);
        } catch (const CORBA::SystemException& e) {
            RTC_WARN(("disconnecting: a peer cannot be called: %s", describe_exception(e).c_str()));
        }
    }
    return std::nullopt;
}

} // namespace

ReturnCode_t PortBase::connect(ConnectorProfile& profile) {
    set_refusal_reason(profile, ""); // from an earlier attempt
    auto refused = [&](ReturnCode_t code, const std::string& reason) {
        set_refusal_reason(profile, reason);
        return refuse(code, reason);
    };
    if (profile.ports.length() == 0) return refused(BAD_PARAMETER, "a connection without ports");
    if (isEmptyId(profile))
        setUUID(profile);
    else if (isExistingConnId(profile.connector_id))
        return refused(PRECONDITION_NOT_MET, std::string("there is a connection with id ") +
                                                 static_cast<const char*>(profile.connector_id));
    try {
        const std::string mismatch = incompatibility(profile);
        if (!mismatch.empty()) return refused(BAD_PARAMETER, mismatch);
        if (has_remote_port(profile) && !allows_duplicates(profile, m_properties) &&
            occurrencesIn(profile) == 1) {
            if (isAlreadyConnected(profile))
                return refused(PRECONDITION_NOT_MET, duplicate_reason(getName()));
            leave_out_duplicate_check(profile);
        }
        const ReturnCode_t result = notify_connect_at(profile.ports[0], profile);
        if (result == RTC_OK) return clearConnectError();
        // A port of OpenRTM-aist gives no reason, but this port may have one.
        const std::string told = refusal_reason(profile);
        const std::string reason = told.empty() ? connectError() : told;
        const std::string id(profile.connector_id);
        disconnect(id.c_str()); // disconnects the ports that were connected before the refusal
        return refused(result, reason.empty() ? "the other side has refused the connection" : reason);
    } catch (const CORBA::SystemException& e) {
        releaseConnection(profile.connector_id);
        return refused(RTC_ERROR, "a port of the connection cannot be reached: " + describe_exception(e));
    }
}

// The preceding port in the profile calls this, possibly from another process, or connect() does. [ORB thread]
ReturnCode_t PortBase::notify_connect(ConnectorProfile& profile) {
    const ReturnCode_t result = establishConnection(profile);
    if (result == RTC_OK && m_onConnected != nullptr) (*m_onConnected)(profile);
    notifyListeners(PortConnectRetListenerType::ON_CONNECTED, profile, result);
    // A port behind this one may already have set the reason.
    if (result != RTC_OK && refusal_reason(profile).empty()) set_refusal_reason(profile, connectError());
    return result;
}

// This port's listeners, then those of the component to all its ports.
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

// The steps of notify_connect(): publish, pass on, subscribe. A step is skipped if the previous step has failed, but
// its listeners are called with the failure.
ReturnCode_t PortBase::establishConnection(ConnectorProfile& profile) {
    // Each port passes the call on to the next one, so a port that is listed twice would call itself endlessly.
    const auto occurrences = occurrencesIn(profile);
    if (occurrences != 1)
        return refuse(BAD_PARAMETER, std::string(getName()) + " is " + std::to_string(occurrences) +
                                         " times in the list of ports to connect, expected once");
    if (!allows_duplicates(profile, m_properties) && isAlreadyConnected(profile))
        return refuse(PRECONDITION_NOT_MET, duplicate_reason(getName()));
    if (const std::string mismatch = incompatibility_with_remote_first(m_objref.in(), profile);
        !mismatch.empty())
        return refuse(BAD_PARAMETER, mismatch);
    clearConnectError();

    using Step = PortConnectRetListenerType;
    notifyListeners(PortConnectListenerType::ON_NOTIFY_CONNECT, profile);
    const auto attempt = [&](auto step) {
        try {
            return step();
        } catch (const std::system_error& e) { // a connection may need a thread
            return refuse(RTC_ERROR, std::string(getName()) + ": " + e.what());
        } catch (const CORBA::SystemException& e) { // it may ask a port of another process
            return refuse(RTC_ERROR,
                          std::string(getName()) +
                              ": a port of the connection cannot be reached: " + describe_exception(e));
        }
    };
    const ReturnCode_t published = attempt([&] { return publishInterfaces(profile); });
    notifyListeners(Step::ON_PUBLISH_INTERFACES, profile, published);
    if (m_onPublishInterfaces != nullptr) (*m_onPublishInterfaces)(profile);
    const ReturnCode_t notified = published == RTC_OK ? notifyNextPort(profile) : published;
    notifyListeners(Step::ON_CONNECT_NEXTPORT, profile, notified);
    if (m_onSubscribeInterfaces != nullptr) (*m_onSubscribeInterfaces)(profile);
    const ReturnCode_t subscribed =
        notified == RTC_OK ? attempt([&] { return subscribeInterfaces(profile); }) : notified;
    notifyListeners(Step::ON_SUBSCRIBE_INTERFACES, profile, subscribed);
    // Kept even if a later step has failed, because disconnect() reads in it what to undo.
    if (published == RTC_OK) updateConnectorProfile(profile);
    // A peer in another process may die without disconnecting, so the manager supervises it from now on.
    if (subscribed == RTC_OK && has_remote_port(profile))
        Manager::instance().impl().connection_keeper->start(profile);
    return subscribed;
}

// A peer that dies or hangs in its notify_connect() leaves this side with half a connection. connect() at the first
// port removes it.
ReturnCode_t PortBase::notifyNextPort(ConnectorProfile& profile) {
    try {
        return connectNext(profile);
    } catch (const CORBA::SystemException& e) {
        return refuse(RTC_ERROR,
                      std::string(getName()) + ": the next port of the connection: " + describe_exception(e));
    }
}

void PortBase::initConnectionLimit() {
    int limit = -1;
    if (coil::stringTo(limit, m_properties.getProperty("connection_limit").c_str()))
        setConnectionLimit(limit);
}

// Only checks the limit; the ports of each kind publish.
ReturnCode_t PortBase::_publishInterfaces() {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    if (m_connectionLimit < 0 ||
        m_profile.connector_profiles.length() < static_cast<CORBA::ULong>(m_connectionLimit))
        return RTC_OK;
    return refuse(RTC_ERROR, std::string(static_cast<const char*>(m_profile.name)) + " has its limit of " +
                                 std::to_string(m_connectionLimit) + " connections");
}

// Returns whether any connection links this port with another port of the profile.
bool PortBase::isAlreadyConnected(const ConnectorProfile& profile) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    const ConnectorProfileList& present = m_profile.connector_profiles;
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        if (m_objref->_is_equivalent(profile.ports[i])) continue;
        for (CORBA::ULong c = 0; c < present.length(); ++c)
            for (CORBA::ULong p = 0; p < present[c].ports.length(); ++p)
                if (present[c].ports[p]->_is_equivalent(profile.ports[i])) return true;
    }
    return false;
}

// Returns how often this port is in the list of the profile.
CORBA::ULong PortBase::occurrencesIn(const ConnectorProfile& profile) const {
    CORBA::ULong occurrences = 0;
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i)
        if (m_objref->_is_equivalent(profile.ports[i])) ++occurrences;
    return occurrences;
}

ReturnCode_t PortBase::connectNext(ConnectorProfile& profile) {
    const auto next = static_cast<CORBA::ULong>(position_of(m_objref.in(), profile)) + 1;
    if (next >= profile.ports.length()) return RTC_OK;
    // Duplicated, because the call replaces the profile and so the reference in its list.
    PortService_var port = RTC::PortService::_duplicate(profile.ports[next]);
    const ReturnCode_t result = notify_connect_at(port.in(), profile);
    if (result == RTC_OK) return result;
    const auto local = local_object<PortBase>(port.in());
    return local ? refuse(result, local->connectError()) : result;
}

ReturnCode_t PortBase::disconnect(const char* connector_id) {
    const ConnectorProfile profile = findConnProfile(connector_id);
    if (profile.ports.length() == 0)
        return refuse(BAD_PARAMETER, std::string(getName()) + " has no connection with id " + connector_id);
    const OrderlyDisconnection orderly(connector_id);
    const auto result = notify_disconnect_from(0, profile, rtclog);
    // Still connected: a peer has not passed the call on to this port. This side ends nevertheless.
    if (releaseConnection(connector_id)) return RTC_OK;
    return result.value_or(RTC_ERROR);
}

// Passes the call on before it ends this port's part, as OpenRTM-aist does, so that all peers are told even
// when this side fails. [ORB thread]
ReturnCode_t PortBase::notify_disconnect(const char* connector_id) {
    ConnectorProfile profile = findConnProfile(connector_id);
    if (profile.ports.length() == 0)
        return refuse(BAD_PARAMETER, std::string(getName()) + " has no connection with id " + connector_id);
    const OrderlyDisconnection orderly(connector_id);
    notifyListeners(PortConnectListenerType::ON_NOTIFY_DISCONNECT, profile);
    const ReturnCode_t result = disconnectNext(profile);
    notifyListeners(PortConnectRetListenerType::ON_DISCONNECT_NEXT, profile, result);
    releaseConnection(connector_id);
    return result;
}

// Ends this port's part of a connection. Returns false if it has none (any more).
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

// If the manager keeps this connection, it makes the connection again. A connection that is being disconnected is not
// lost: a write that finds no receiver comes between the other port's release and this port's.
void PortBase::dropLostConnection(const char* connector_id) {
    if (OrderlyDisconnection::includes(connector_id)) return;
    ConnectorProfile profile = findConnProfile(connector_id);
    if (profile.ports.length() == 0) return;
    RTC_WARN(("the other side of connection %s is gone", connector_id));
    if (m_onConnectionLost != nullptr) (*m_onConnectionLost)(profile);
    // The lost port, which would have passed the call on, cannot reach the ports of this process.
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i)
        if (auto local = local_object<PortBase>(profile.ports[i])) local->releaseConnection(connector_id);
    Manager::instance().impl().connection_keeper->report_lost(profile);
}

ReturnCode_t PortBase::disconnectNext(ConnectorProfile& profile) {
    const CORBA::Long position = position_of(m_objref.in(), profile);
    if (position < 0) return BAD_PARAMETER;
    const auto next = static_cast<CORBA::ULong>(position) + 1;
    return notify_disconnect_from(next, profile, rtclog).value_or(RTC_OK);
}

// The result is the last failure. The other connections are disconnected nevertheless.
ReturnCode_t PortBase::disconnect_all() {
    ConnectorProfileList_var profiles = get_connector_profiles();
    ReturnCode_t result = RTC_OK;
    for (CORBA::ULong i = 0; i < profiles->length(); ++i) {
        const ReturnCode_t disconnected = disconnect(profiles[i].connector_id);
        if (disconnected != RTC_OK) result = disconnected;
    }
    return result;
}

} // namespace RTC
