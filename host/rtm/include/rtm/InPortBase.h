// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INPORTBASE_H
#define RTC_INPORTBASE_H
#include <atomic>
#include <memory>
#include <rtm/CdrBufferBase.h>
#include <rtm/ConnectorListener.h>
#include <rtm/DataPortStatus.h>
#include <rtm/InPortConnector.h>
#include <rtm/PortBase.h>

namespace RTC {
class PushReceiver;
class InPortPushConnector;

/// A data port that receives. Its connectors share one ring buffer, except those whose connection names a
/// `buffer_type`. Derive from it for a port whose data type is only known at run time.
class InPortBase : public PortBase {
  public:
    using ConnectorList = std::vector<InPortConnector*>;

    InPortBase(const char* name, const char* data_type);
    ~InPortBase() override;
    /// Is called with the port's properties of rtc.conf when the port is added to its component.
    virtual void init(coil::Properties& prop);
    virtual bool read(std::string name = "") = 0;
    virtual bool isNew() { return findReadable() != nullptr; }
    virtual bool isEmpty() { return findReadable() == nullptr; }

    /// Returns the port's configuration: the defaults for every connection's properties.
    coil::Properties& properties() { return m_properties; }
    const std::vector<InPortConnector*>& connectors() { return m_connectors; }
    ConnectorInfoList getConnectorProfiles();
    coil::vstring getConnectorIds();
    coil::vstring getConnectorNames();
    /// Returns NULL if there is none. Do not keep the connector: it is deleted when its connection ends.
    InPortConnector* getConnectorById(const char* id);
    InPortConnector* getConnectorByName(const char* name);
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

    /// Ours: returns where an OutPort of this process writes the messages of this connection, or NULL if it is not a
    /// push connection of this port. [any-thread]
    std::shared_ptr<PushReceiver> pushReceiver(const char* connector_id);
    /// Ours: sets the time in a received message (timestamp_policy on_received). [sender's or ORB thread]
    virtual void stampOnReceive(ByteData& bytes);
    /// Ours: returns the buffer of `direct` connections, which accepts unserialized values, or NULL for a port that
    /// accepts only bytes.
    virtual std::shared_ptr<DirectBufferBase> directBuffer() { return nullptr; }

  protected:
    ReturnCode_t publishInterfaces(ConnectorProfile& connector_profile) override;
    ReturnCode_t subscribeInterfaces(const ConnectorProfile& connector_profile) override;
    void unsubscribeInterfaces(const ConnectorProfile& connector_profile) override;
    /// Returns the connector to read next: the first with data, or NULL if none has data. Locks m_dataMutex.
    InPortConnector* findReadable();
    /// Like findReadable(), for a caller that holds m_dataMutex. `name` selects connectors by name; empty: all.
    /// `fallback_to_first`: if none has data, returns the first one, for its status.
    InPortConnector* findReadableLocked(const std::string& name, bool fallback_to_first);

    /// Ours: decodes the next message in place and sets m_status. Returns false, without side effects, unless the
    /// port has one connector with an in-place buffer and standard CDR, and nothing else needs the bytes or sets the
    /// time. Locks m_dataMutex.
    bool readFastPath(Unmarshal& reader);
    bool hasFastPath() const { return m_fastPath.load(std::memory_order_relaxed) != nullptr; }
    /// Call it with m_dataMutex held, after the sole connector has read a value, if the connector allows the fast
    /// path (readsInPlace()).
    void findFastPath() { m_fastPath = m_connectors.front(); }

    DataPortStatusList m_status{DataPortStatus::PORT_OK}; // of the last read
    bool m_singlebuffer = true; // connectors share m_thebuffer; components may set it to false
    CdrBufferBase* m_thebuffer = nullptr;
    ConnectorList m_connectors;
    bool m_littleEndian = true;
    ConnectorListenersBase m_listeners;

  private:
    ReturnCode_t addPushConnector(ConnectorProfile& connector_profile, const coil::Properties& prop);
    ReturnCode_t addPushProvider(ConnectorProfile& connector_profile, const coil::Properties& prop,
                                 const std::string& type, std::unique_ptr<InPortPushConnector> connector);
    ReturnCode_t addPullConnector(const ConnectorProfile& connector_profile, const coil::Properties& prop);
    void addConnector(InPortConnector* connector);
    InPortConnector* findFirstReadable(); // with m_dataMutex held
    InPortConnector* findNothing();

    // Changes with m_dataMutex held. NULL: unknown or not allowed.
    std::atomic<InPortConnector*> m_fastPath{nullptr};
    unsigned m_emptyLooks = 0; // [owner's thread]
};

} // namespace RTC
#endif
