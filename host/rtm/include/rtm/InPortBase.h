// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INPORTBASE_H
#define RTC_INPORTBASE_H
#include <memory>
#include <rtm/CdrBufferBase.h>
#include <rtm/ConnectorListener.h>
#include <rtm/DataPortStatus.h>
#include <rtm/InPortConnector.h>
#include <rtm/PortBase.h>

namespace RTC {
class PushReceiver;
class InPortPushConnector;

/// A data port that receives. Connectors share one ring buffer, unless a connector asks for a buffer type of
/// its own. Derive from it for a port whose type is known at run time only.
class InPortBase : public PortBase {
  public:
    using ConnectorList = std::vector<InPortConnector*>;

    InPortBase(const char* name, const char* data_type);
    ~InPortBase() override;
    /// With the port's properties of rtc.conf, when the port is added to its component.
    virtual void init(coil::Properties& prop);
    virtual bool read(std::string name = "") = 0;
    virtual bool isNew() { return findReadable() != nullptr; }
    virtual bool isEmpty() { return findReadable() == nullptr; }

    coil::Properties& properties() { return m_properties; }
    const std::vector<InPortConnector*>& connectors() { return m_connectors; }
    ConnectorInfoList getConnectorProfiles();
    coil::vstring getConnectorIds();
    coil::vstring getConnectorNames();
    InPortConnector* getConnectorById(const char* id);
    InPortConnector* getConnectorByName(const char* name);
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

    /// Ours: the local end of a connector, for an OutPort of this process; NULL when there is none.
    std::shared_ptr<PushReceiver> pushReceiver(const char* connector_id);
    /// Ours: puts the time into a message that has arrived (timestamp_policy on_received).
    virtual void stampOnReceive(ByteData& bytes);
    /// Ours: the buffer of `direct` connections; NULL for a port that takes bytes only.
    virtual std::shared_ptr<DirectBufferBase> directBuffer() { return nullptr; }

  protected:
    ReturnCode_t publishInterfaces(ConnectorProfile& connector_profile) override;
    ReturnCode_t subscribeInterfaces(const ConnectorProfile& connector_profile) override;
    void unsubscribeInterfaces(const ConnectorProfile& connector_profile) override;
    /// The connector to read next: one with data, NULL when none has any. Locks m_connectorsMutex.
    InPortConnector* findReadable();
    /// The same for a holder of m_connectorsMutex; `name` empty: any.
    InPortConnector* findReadableLocked(const std::string& name, bool fallback_to_first);

    bool m_singlebuffer = true;
    CdrBufferBase* m_thebuffer = nullptr;
    ConnectorList m_connectors;
    bool m_littleEndian = true;
    ConnectorListenersBase m_listeners;

  private:
    ReturnCode_t addPushConnector(ConnectorProfile& connector_profile, const coil::Properties& prop);
    ReturnCode_t addPushProvider(ConnectorProfile& connector_profile, const coil::Properties& prop,
                                 const std::string& type, InPortPushConnector* connector);
    ReturnCode_t addPullConnector(const ConnectorProfile& connector_profile, const coil::Properties& prop);
    void addConnector(InPortConnector* connector);
};

} // namespace RTC
#endif
