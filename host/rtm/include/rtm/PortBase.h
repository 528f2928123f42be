// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_PORTBASE_H
#define RTC_PORTBASE_H
#include <iostream>
#include <mutex>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/DataMutex.h>
#include <rtm/NVUtil.h>
#include <rtm/PortCallback.h>
#include <rtm/PortConnectListener.h>
#include <rtm/RTC.h>
#include <rtm/SystemLogger.h>
#include <string>

namespace RTC {

/// A port: a servant of the IDL interface RTC::PortService from construction to destruction, with OpenRTM-aist's
/// connection protocol. connect() calls notify_connect() of the first port in the profile. That port publishes what
/// it provides, passes the profile to the next port, and then subscribes to what the others have published. All
/// functions: [any-thread]. connect() and disconnect() of ports in other processes block at most for the ORB's time
/// limit.
class PortBase : public virtual POA_RTC::PortService, public virtual PortableServer::RefCountServantBase {
  public:
    explicit PortBase(const char* name = "");
    ~PortBase() override;

    PortProfile* get_port_profile() override;
    const PortProfile& getPortProfile() const { return m_profile; }
    /// Ours: returns a copy without the connections, which may be many.
    PortProfile profileWithoutConnections() const;
    ConnectorProfileList* get_connector_profiles() override;
    /// Returns a profile with an empty id if there is no such connection.
    ConnectorProfile* get_connector_profile(const char* connector_id) override;
    /// Connects the ports of the profile and gives it an id if it has none. Returns BAD_PARAMETER if the ports do not
    /// match, PRECONDITION_NOT_MET if the id is in use, otherwise the code with which a port has refused.
    /// connectError() gives the reason.
    ReturnCode_t connect(ConnectorProfile& connector_profile) override;
    ReturnCode_t notify_connect(ConnectorProfile& connector_profile) override;
    /// Ends a connection at all its ports; at this port even if others do not answer. Returns BAD_PARAMETER if there
    /// is no such id.
    ReturnCode_t disconnect(const char* connector_id) override;
    ReturnCode_t notify_disconnect(const char* connector_id) override;
    ReturnCode_t disconnect_all() override;

    /// Are called when the component is activated and deactivated.
    virtual void activateInterfaces() = 0;
    virtual void deactivateInterfaces() = 0;
    /// Ours, for execution contexts: runs the code of a read or a write without taking or sending a message. Waits for no
    /// lock. [thread of the context]
    void rehearse();

    void setName(const char* name);
    const char* getName() const { return m_profile.name; }
    const PortProfile& getProfile() const { return m_profile; }
    void setPortRef(PortService_ptr port_ref);
    PortService_ptr getPortRef() const;
    /// Sets the component that owns the port. The port's name becomes `<instance>.<name>`.
    void setOwner(RTObject_ptr owner);
    /// Ours: sets an owner that is being created and therefore cannot be asked for its name.
    void setOwner(RTObject_ptr owner, const char* instance_name);

    // Callbacks of 1.x at the steps of a connection. NULL: none. The caller keeps ownership.
    void setOnPublishInterfaces(ConnectionCallback* callback) { m_onPublishInterfaces = callback; }
    void setOnSubscribeInterfaces(ConnectionCallback* callback) { m_onSubscribeInterfaces = callback; }
    void setOnConnected(ConnectionCallback* callback) { m_onConnected = callback; }
    void setOnUnsubscribeInterfaces(ConnectionCallback* callback) { m_onUnsubscribeInterfaces = callback; }
    void setOnDisconnected(ConnectionCallback* callback) { m_onDisconnected = callback; }
    void setOnConnectionLost(ConnectionCallback* callback) { m_onConnectionLost = callback; }

    void addPortConnectListener(PortConnectListenerType type, PortConnectListener* listener,
                                bool autoclean = true) {
        m_connectListeners.at(type).addListener(listener, autoclean);
    }
    void removePortConnectListener(PortConnectListenerType type, PortConnectListener* listener) {
        m_connectListeners.at(type).removeListener(listener);
    }
    void addPortConnectRetListener(PortConnectRetListenerType type, PortConnectRetListener* listener,
                                   bool autoclean = true) {
        m_connectListeners.at(type).addListener(listener, autoclean);
    }
    void removePortConnectRetListener(PortConnectRetListenerType type, PortConnectRetListener* listener) {
        m_connectListeners.at(type).removeListener(listener);
    }

    /// Sets the component's listeners to all its ports, called after this port's own. NULL: none.
    void setPortConnectListenerHolder(PortConnectListeners* listeners) {
        m_componentConnectListeners = listeners;
    }

    /// Ours: returns, in one line, why the last connect() or notify_connect() of this port was refused, or an empty
    /// string.
    std::string connectError() const;
    /// Ours: ends a connection whose peer is gone, without calling the peer.
    void dropLostConnection(const char* connector_id);
    /// Ours: deactivates the CORBA object and waits (1 s at most) for running calls. The component calls it before
    /// the port is destroyed.
    virtual void retire();

  protected:
    /// Implements rehearse(): the same calls as a read or a write, which have no effect then.
    virtual void rehearseMessage() {}
    /// Steps of notify_connect() and of disconnection, implemented by each type of port: publish writes what this
    /// port provides into the profile, subscribe uses what the others have published.
    virtual ReturnCode_t publishInterfaces(ConnectorProfile& connector_profile) = 0;
    virtual ReturnCode_t subscribeInterfaces(const ConnectorProfile& connector_profile) = 0;
    virtual void unsubscribeInterfaces(const ConnectorProfile& connector_profile) = 0;
    virtual ReturnCode_t connectNext(ConnectorProfile& connector_profile);
    virtual ReturnCode_t disconnectNext(ConnectorProfile& connector_profile);

    /// Sets the maximum number of connections. Negative: any number.
    virtual void setConnectionLimit(int limit_value) { m_connectionLimit = limit_value; }
    /// Ours: sets the limit to the port's property `connection_limit`. Without a valid number, the limit does not
    /// change.
    void initConnectionLimit();
    /// Returns RTC_ERROR if the connection limit is reached.
    virtual ReturnCode_t _publishInterfaces();
    /// Ours: sets connectError() to `reason` and returns `code`.
    ReturnCode_t refuse(ReturnCode_t code, const std::string& reason);
    /// Ours: notes that the last connection has succeeded. Returns RTC_OK.
    ReturnCode_t clearConnectError();

    static bool isEmptyId(const ConnectorProfile& connector_profile);
    static std::string getUUID();
    static void setUUID(ConnectorProfile& connector_profile);
    bool isExistingConnId(const char* id);
    ConnectorProfile findConnProfile(const char* id);
    CORBA::Long findConnProfileIndex(const char* id) const;
    void updateConnectorProfile(const ConnectorProfile& connector_profile);
    bool eraseConnectorProfile(const char* id);
    bool appendInterface(const char* instance_name, const char* type_name, PortInterfacePolarity polarity);
    bool deleteInterface(const char* name, PortInterfacePolarity polarity);

    template <class ValueType>
    void addProperty(const char* key, ValueType value) {
        const std::lock_guard<std::mutex> lock(m_profile_mutex);
        CORBA_SeqUtil::push_back(m_profile.properties, NVUtil::newNV(key, value));
    }
    void appendProperty(const char* key, const char* value) {
        const std::lock_guard<std::mutex> lock(m_profile_mutex);
        NVUtil::appendStringValue(m_profile.properties, key, value);
    }

    mutable Logger rtclog;
    coil::Properties m_properties;
    PortProfile m_profile;
    RTC::PortService_var m_objref;
    mutable std::mutex m_profile_mutex;
    /// Guards the list of connectors.
    mutable std::mutex m_connectorsMutex;
    /// Ours: held by data ports while they write or read. The list of connectors changes with both mutexes held, so
    /// either protects reading it. Lock this one last.
    mutable DataMutex m_dataMutex;
    std::string m_ownerInstanceName = "unknown";
    int m_connectionLimit = -1;
    ConnectionCallback* m_onPublishInterfaces = nullptr;
    ConnectionCallback* m_onSubscribeInterfaces = nullptr;
    ConnectionCallback* m_onConnected = nullptr;
    ConnectionCallback* m_onUnsubscribeInterfaces = nullptr;
    ConnectionCallback* m_onDisconnected = nullptr;
    ConnectionCallback* m_onConnectionLost = nullptr;

  private:
    ReturnCode_t establishConnection(ConnectorProfile& connector_profile);
    ReturnCode_t notifyNextPort(ConnectorProfile& connector_profile);
    bool releaseConnection(const char* connector_id);
    void notifyListeners(PortConnectListenerType type, ConnectorProfile& profile);
    void notifyListeners(PortConnectRetListenerType type, ConnectorProfile& profile, ReturnCode_t result);
    bool isAlreadyConnected(const ConnectorProfile& connector_profile);
    CORBA::ULong occurrencesIn(const ConnectorProfile& connector_profile) const;

    PortableServer::POA_var m_poa;
    PortableServer::ObjectId_var m_oid;
    bool m_retired = false;
    mutable std::mutex m_errorMutex;
    std::string m_connectError;
    PortConnectListeners m_connectListeners;
    PortConnectListeners* m_componentConnectListeners = nullptr;
};

} // namespace RTC
#endif
