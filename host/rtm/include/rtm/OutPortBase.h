// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OUTPORTBASE_H
#define RTC_OUTPORTBASE_H
#include <atomic>
#include <memory>
#include <rtm/ConnectorListener.h>
#include <rtm/DataPortStatus.h>
#include <rtm/OutPortConnector.h>
#include <rtm/PortBase.h>

namespace RTC {
class OutPortPushConnector;
class PullBuffer;

/// A data port that sends. Derive from it for a port whose data type is only known at run time.
class OutPortBase : public PortBase {
  public:
    using ConnectorList = std::vector<OutPortConnector*>;

    OutPortBase(const char* name, const char* data_type);
    ~OutPortBase() override;
    /// Is called with the port's properties of rtc.conf when the port is added to its component.
    virtual void init(coil::Properties& prop);
    virtual bool write() = 0;

    /// Returns the port's configuration: the defaults for every connection's properties.
    coil::Properties& properties() { return m_properties; }
    const std::vector<OutPortConnector*>& connectors() { return m_connectors; }
    ConnectorInfoList getConnectorProfiles();
    coil::vstring getConnectorIds();
    coil::vstring getConnectorNames();
    /// Returns NULL if there is none. Do not keep the connector: it is deleted when its connection ends.
    OutPortConnector* getConnectorById(const char* id);
    OutPortConnector* getConnectorByName(const char* name);
    /// Returns false if there is none.
    bool getConnectorProfileById(const char* id, ConnectorInfo& prof);
    bool getConnectorProfileByName(const char* name, ConnectorInfo& prof);
    void activateInterfaces() override;
    void deactivateInterfaces() override;

    /// `autoclean`: the listener is deleted when it is removed or when the port is destroyed. Listeners run in the
    /// thread that causes the event. [any-thread]
    void addConnectorDataListener(ConnectorDataListenerType type, ConnectorDataListener* listener,
                                  bool autoclean = true);
    void removeConnectorDataListener(ConnectorDataListenerType type, ConnectorDataListener* listener);
    void addConnectorListener(ConnectorListenerType type, ConnectorListener* listener, bool autoclean = true);
    void removeConnectorListener(ConnectorListenerType type, ConnectorListener* listener);
    ConnectorListenersBase* getListeners() { return &m_listeners; }
    bool isLittleEndian() { return m_littleEndian; }

    /// Ours: returns where an InPort of this process fetches the messages of this connection, or NULL if it is not a
    /// pull connection of this port. [any-thread]
    std::shared_ptr<PullBuffer> pullBuffer(const char* connector_id);

  protected:
    ReturnCode_t publishInterfaces(ConnectorProfile& connector_profile) override;
    ReturnCode_t subscribeInterfaces(const ConnectorProfile& connector_profile) override;
    void unsubscribeInterfaces(const ConnectorProfile& connector_profile) override;
    /// Ends the connections with these ids, whose receiver was gone during a write. The caller must not hold
    /// m_dataMutex.
    void dropLostConnections(const std::vector<std::string>& connector_ids);

    /// Ours: encodes most messages directly into the receiver's buffer. Requires that the port has one connector, to
    /// an InPort of this process whose buffer takes each message in place, with standard CDR, and that nothing needs
    /// the bytes or sets the time. Otherwise returns `none` without side effects. Locks m_dataMutex. Never returns
    /// `none` in rehearse().
    enum class FastPath : std::uint8_t { none, accepted, refused };
    FastPath writeFastPath(const Marshal& marshal);
    /// Ours, for rehearseMessage() without a fast path.
    void rehearseWrite(const Marshal& marshal);
    bool hasFastPath() const { return m_fastPath.load(std::memory_order_relaxed) != nullptr; }
    /// Call it with m_dataMutex held, after the sole connector has written a value, if the connector allows the fast
    /// path (writesInPlace()).
    void findFastPath();

    DataPortStatusList m_status; // of the last write, by connector
    std::vector<OutPortConnector*> m_connectors;
    bool m_littleEndian = true;
    ConnectorListenersBase m_listeners;

  private:
    // Changes with m_dataMutex held. NULL: unknown or not allowed.
    std::atomic<OutPortPushConnector*> m_fastPath{nullptr};
    ReturnCode_t addPushConnectors(const ConnectorProfile& connector_profile, const coil::Properties& prop);
    ReturnCode_t addPullConnector(ConnectorProfile& connector_profile, const coil::Properties& prop);
    void addConnector(OutPortConnector* connector);
};

} // namespace RTC
#endif
