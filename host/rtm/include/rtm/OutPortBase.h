// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OUTPORTBASE_H
#define RTC_OUTPORTBASE_H
#include <memory>
#include <rtm/ConnectorListener.h>
#include <rtm/DataPortStatus.h>
#include <rtm/OutPortConnector.h>
#include <rtm/PortBase.h>

namespace RTC {
class PullBuffer;

/// A data port that sends. Derive from it for a port whose type is known at run time only.
class OutPortBase : public PortBase {
  public:
    using ConnectorList = std::vector<OutPortConnector*>;

    OutPortBase(const char* name, const char* data_type);
    ~OutPortBase() override;
    /// With the port's properties of rtc.conf, when the port is added to its component.
    virtual void init(coil::Properties& prop);
    virtual bool write() = 0;

    coil::Properties& properties() { return m_properties; }
    const std::vector<OutPortConnector*>& connectors() { return m_connectors; }
    ConnectorInfoList getConnectorProfiles();
    coil::vstring getConnectorIds();
    coil::vstring getConnectorNames();
    OutPortConnector* getConnectorById(const char* id);
    OutPortConnector* getConnectorByName(const char* name);
    bool getConnectorProfileById(const char* id, ConnectorInfo& prof);
    bool getConnectorProfileByName(const char* name, ConnectorInfo& prof);
    void activateInterfaces() override;
    void deactivateInterfaces() override;

    void addConnectorDataListener(ConnectorDataListenerType type, ConnectorDataListener* listener,
                                  bool autoclean = true);
    void removeConnectorDataListener(ConnectorDataListenerType type, ConnectorDataListener* listener);
    void addConnectorListener(ConnectorListenerType type, ConnectorListener* listener, bool autoclean = true);
    void removeConnectorListener(ConnectorListenerType type, ConnectorListener* listener);
    ConnectorListenersBase* getListeners() { return &m_listeners; }
    bool isLittleEndian() { return m_littleEndian; }

    /// Ours: the local end of a pull connector, for an InPort of this process; NULL when there is none.
    std::shared_ptr<PullBuffer> pullBuffer(const char* connector_id);

  protected:
    ReturnCode_t publishInterfaces(ConnectorProfile& connector_profile) override;
    ReturnCode_t subscribeInterfaces(const ConnectorProfile& connector_profile) override;
    void unsubscribeInterfaces(const ConnectorProfile& connector_profile) override;
    /// Disconnects what a write has found dead. Not with m_connectorsMutex held.
    void dropLostConnections(const std::vector<std::string>& connector_ids);

    std::vector<OutPortConnector*> m_connectors;
    bool m_littleEndian = true;
    ConnectorListenersBase m_listeners;

  private:
    ReturnCode_t addPushConnectors(const ConnectorProfile& connector_profile, const coil::Properties& prop);
    ReturnCode_t addPullConnector(ConnectorProfile& connector_profile, const coil::Properties& prop);
    void addConnector(OutPortConnector* connector);
};

} // namespace RTC
#endif
