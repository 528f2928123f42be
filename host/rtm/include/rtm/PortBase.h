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

/// A port: a servant of the IDL interface RTC::PortService from construction to destruction, with
/// OpenRTM-aist's connection protocol: connect() calls notify_connect() of the first port in the profile;
/// that port publishes what it provides, passes the profile on to the next port, and then subscribes to what
/// the others have published. All functions [any-thread]. connect() and disconnect() of ports in other
/// processes block for the ORB's time limit at most.
class PortBase : public virtual POA_RTC::PortService, public virtual PortableServer::RefCountServantBase {
  public:
    explicit PortBase(const char* name = "");
    ~PortBase() override;

    PortProfile* get_port_profile() override;
    const PortProfile& getPortProfile() const { return m_profile; }
    ConnectorProfileList* get_connector_profiles() override;
    /// With an empty id when there is no such connection.
    ConnectorProfile* get_connector_profile(const char* connector_id) override;
    /// Connects the ports of the profile and gives it an id when it has none. BAD_PARAMETER: the ports do not
    /// fit; PRECONDITION_NOT_MET: the id is in use; else what a port has refused it with. connectError() says
    /// why.
    ReturnCode_t connect(ConnectorProfile& connector_profile) override;
    ReturnCode_t notify_connect(ConnectorProfile& connector_profile) override;
    /// Ends a connection at all its ports; at this one also when others do not answer. BAD_PARAMETER: no such
    /// id.
    ReturnCode_t disconnect(const char* connector_id) override;
    ReturnCode_t notify_disconnect(const char* connector_id) override;
    ReturnCode_t disconnect_all() override;

    /// Called when the component is activated, and when it is deactivated.
    virtual void activateInterfaces() = 0;
    virtual void deactivateInterfaces() = 0;
    /// Ours, for execution contexts: goes the way of a coming message without sending one, so that its code and data are in
    /// the caches. Waits for no lock. [thread of the context]
    virtual void warmUp() {}

    void setName(const char* name);
    const char* getName() const { return m_profile.name; }
    const PortProfile& getProfile() const { return m_profile; }
    void setPortRef(PortService_ptr port_ref);
    PortService_ptr getPortRef() const;
    /// Sets the component that has the port, whose name becomes `<instance>.<name>`.
    void setOwner(RTObject_ptr owner);
    /// Ours: the same while the owner is being created and cannot be asked for its name.
    void setOwner(RTObject_ptr owner, const char* instance_name);

    // Callbacks of 1.x at the steps of a connection; NULL: none. They stay the caller's.
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

    /// The component's listeners to all its ports, called after this port's own; NULL: none.
    void setPortConnectListenerHolder(PortConnectListeners* listeners) {
        m_componentConnectListeners = listeners;
    }

    /// Ours: why the last connect() or notify_connect() of this port was refused, in one line; empty when it
    /// was not.
    std::string connectError() const;
    /// Ours: ends a connection whose peer is gone, without calling the peer.
    void dropLostConnection(const char* connector_id);
    /// Ours: deactivates the CORBA object and waits (1 s at most) for calls under way. Called by the
    /// component before it is destroyed.
    virtual void retire();

  protected:
    /// Steps of notify_connect() and of the disconnection, which each kind of port implements: publish writes
    /// into the profile what this port provides, subscribe uses what the others have published.
    virtual ReturnCode_t publishInterfaces(ConnectorProfile& connector_profile) = 0;
    virtual ReturnCode_t subscribeInterfaces(const ConnectorProfile& connector_profile) = 0;
    virtual void unsubscribeInterfaces(const ConnectorProfile& connector_profile) = 0;
    virtual ReturnCode_t connectNext(ConnectorProfile& connector_profile);
    virtual ReturnCode_t disconnectNext(ConnectorProfile& connector_profile);

    /// The number of connections at most; negative: any number.
    virtual void setConnectionLimit(int limit_value) { m_connectionLimit = limit_value; }
    /// Ours: sets the limit to the port's property `connection_limit`; without such a number it stays as it is.
    void initConnectionLimit();
    /// RTC_ERROR when the connection limit is reached.
    virtual ReturnCode_t _publishInterfaces();
    /// Ours: makes `reason` the connectError() and returns `code`.
    ReturnCode_t refuse(ReturnCode_t code, const std::string& reason);
    /// Ours: the last connection has succeeded. Returns RTC_OK.
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
        CORBA_SeqUtil::push_back(m_profile.properties, NVUtil::newNV(key, value));
    }
    void appendProperty(const char* key, const char* value) {
        NVUtil::appendStringValue(m_profile.properties, key, value);
    }

    mutable Logger rtclog;
    coil::Properties m_properties;
    PortProfile m_profile;
    RTC::PortService_var m_objref;
    mutable std::mutex m_profile_mutex;
    /// Guards the list of connectors.
    mutable std::mutex m_connectorsMutex;
    /// Ours: held by data ports while they write or read. The list of connectors changes with both mutexes held, this
    /// one locked last, so that it may be used with either.
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
