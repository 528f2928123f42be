// SPDX-License-Identifier: Apache-2.0
// OutPortBase: makes the connectors of an OutPort when it is connected.
#include "host/rt/rehearsal.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include "host/rtm/runtime/port/data_mutex.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/out_port_connectors.hpp"
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include "host/rtm/runtime/transport/ring/ring_sender.hpp"
#include <rtm/InPortBase.h>
#include <rtm/OutPortBase.h>

namespace RTC {
namespace {

// Tells each push connector whether it is the port's only one. The caller holds both mutexes.
void update_sole_connector(const std::vector<OutPortConnector*>& connectors) {
    for (auto* connector : connectors)
        if (auto* push = dynamic_cast<OutPortPushConnector*>(connector))
            push->set_sole_connector(connectors.size() == 1);
}

// With two ports, there is at most one other port, which is not asked.
std::size_t count_remote_in_ports(const ConnectorProfile& profile) {
    std::size_t count = 0;
    for (CORBA::ULong i = 0; profile.ports.length() > 2 && i < profile.ports.length(); ++i) {
        if (local_object<PortBase>(profile.ports[i]) != nullptr) continue;
        const PortProfile_var port = profile.ports[i]->get_port_profile();
        if (std::string(NVUtil::toString(port->properties, "port.port_type")) == "DataInPort") ++count;
    }
    return count;
}

} // namespace

OutPortBase::OutPortBase(const char* name, const char* data_type) : PortBase(name) {
    // Tools and peers read these in the port's profile; init() adds the transports of libraries.
    addProperty("port.port_type", "DataOutPort");
    addProperty("dataport.data_type", data_type);
    addProperty("dataport.subscription_type", "flush, new, periodic");
    addProperty("dataport.dataflow_type", "push, pull");
    addProperty("dataport.interface_type", "corba_cdr, data_service, direct, shared_memory");
}

OutPortBase::~OutPortBase() {
    retire(); // first, so that no call from outside reaches the objects that are deleted next
    for (auto* connector : m_connectors) delete connector;
}

void OutPortBase::init(coil::Properties& prop) {
    m_properties << prop;
    {
        const std::lock_guard lock(m_profile_mutex);
        NVUtil::mergeFromProperties(m_profile.properties, m_properties);
        append_registered_types(m_profile.properties, false);
    }
    initConnectionLimit();
}

// Pull: the buffer must exist before the InPort subscribes to it, so its connector is made in this step.
ReturnCode_t OutPortBase::publishInterfaces(ConnectorProfile& profile) {
    const ReturnCode_t allowed = _publishInterfaces();
    if (allowed != RTC_OK) return allowed;
    const coil::Properties prop = connector_properties(m_properties, profile, "outport");
    const std::string reason = unsupported_reason(profile, prop, false);
    if (!reason.empty()) return refuse(BAD_PARAMETER, std::string(getName()) + ": " + reason);
    const std::string flow = coil::normalize(prop.getProperty("dataflow_type", "push"));
    return flow == "pull" ? addPullConnector(profile, prop) : RTC_OK;
}

// The connector of a pull connection, whose address goes into the profile, by CORBA or a library's provider.
ReturnCode_t OutPortBase::addPullConnector(ConnectorProfile& profile, const coil::Properties& prop) {
    ConnectorInfo info = connector_info(profile, prop);
    auto connector = std::make_unique<OutPortPullConnector>(*this, info);
    const std::string registered = registered_pull_type(prop);
    if (registered.empty()) {
        publish_object(profile, address_key(corba_interface_type(prop), "outport"),
                       connector->servant().reference(), connector->servant().ior());
    } else {
        auto provider = create_registered_out_provider(registered, prop);
        if (provider == nullptr)
            return refuse(RTC_ERROR, std::string(getName()) + ": interface type " + registered +
                                         " has no OutPortProvider here; load the library that brings it");
        provider->setListener(info, &m_listeners);
        provider->setBuffer(connector->getBuffer());
        provider->setConnector(connector.get());
        if (!provider->publishInterface(profile.properties))
            return refuse(RTC_ERROR, std::string(getName()) + ": the OutPortProvider of interface type " +
                                         registered + " publishes nothing");
        connector->set_provider(std::move(provider));
    }
    addConnector(connector.release());
    return RTC_OK;
}

// Push: the InPorts have published where to send to.
ReturnCode_t OutPortBase::subscribeInterfaces(const ConnectorProfile& profile) {
    const coil::Properties prop = connector_properties(m_properties, profile, "outport");
    const std::string flow = coil::normalize(prop.getProperty("dataflow_type", "push"));
    return flow == "push" ? addPushConnectors(profile, prop) : RTC_OK;
}

// One connector for each InPort of this process, or one for the InPort of another process: OpenRTM-aist's
// profile has room for one address of each interface type.
ReturnCode_t OutPortBase::addPushConnectors(const ConnectorProfile& profile, const coil::Properties& prop) {
    ConnectorInfo info = connector_info(profile, prop);
    const std::string registered = registered_push_type(prop);
    if (!registered.empty()) {
        auto receiver = create_registered_receiver(registered, profile, prop);
        if (receiver == nullptr)
            return refuse(RTC_ERROR, std::string(getName()) + ": interface type " + registered +
                                         " has no InPortConsumer here, or it does not find the other side");
        addConnector(new OutPortPushConnector(*this, info, std::move(receiver)));
        return RTC_OK;
    }
    bool is_local = false; // an InPort of this process takes the messages directly
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        auto port = local_object<InPortBase>(profile.ports[i]);
        auto receiver = port ? port->pushReceiver(profile.connector_id) : nullptr;
        if (receiver == nullptr) continue;
        addConnector(new OutPortPushConnector(*this, info, receiver));
        is_local = true;
    }
    if (const auto remote = count_remote_in_ports(profile); remote + (is_local ? 1 : 0) > 1)
        return refuse(BAD_PARAMETER, std::string(getName()) + ": the connection has " +
                                         std::to_string(remote) +
                                         " InPorts of other processes, expected one InPort; connect each "
                                         "InPort separately");
    if (is_local) return RTC_OK;
    if (Publisher::delivers_newest_only(prop)) {
        if (auto numbered =
                NumberedReceiver::find(profile, RemotePush::limits_from(prop).thread_answer_timeout)) {
            addConnector(new OutPortPushConnector(*this, info, std::move(numbered)));
            return RTC_OK;
        }
    }
    auto remote = RemoteReceiver::find(profile, corba_interface_type(prop));
    if (remote == nullptr)
        return refuse(RTC_ERROR, std::string(getName()) + ": the other side offers no " +
                                     corba_interface_type(prop) + " reference to push to");
    remote =
        add_ring_if_possible(std::move(remote), profile, RemotePush::limits_from(prop).sole_answer_timeout);
    addConnector(new OutPortPushConnector(*this, info, std::move(remote)));
    return RTC_OK;
}

// Takes over the connector. The listeners are called without the lock: they may write to the port.
void OutPortBase::addConnector(OutPortConnector* connector) {
    ConnectorInfo info = connector->profile();
    {
        const std::lock_guard lock(m_connectorsMutex);
        const std::lock_guard data_lock(m_dataMutex);
        m_connectors.push_back(connector);
        m_fastPath = nullptr;
        update_sole_connector(m_connectors);
    }
    m_listeners.notify(ConnectorListenerType::ON_CONNECT, info);
}

void OutPortBase::unsubscribeInterfaces(const ConnectorProfile& profile) {
    std::vector<std::unique_ptr<OutPortConnector>> removed;
    {
        const std::lock_guard lock(m_connectorsMutex);
        const std::lock_guard data_lock(m_dataMutex);
        // A connection with several InPorts of this process has several connectors of one id.
        for (std::size_t i = m_connectors.size(); i-- > 0;) {
            if (std::string(m_connectors[i]->id()) != static_cast<const char*>(profile.connector_id))
                continue;
            removed.emplace_back(m_connectors[i]);
            m_connectors.erase(m_connectors.begin() + static_cast<std::ptrdiff_t>(i));
        }
        m_fastPath = nullptr;
        update_sole_connector(m_connectors);
    }
    // Not under the lock: disconnect() waits for a delivery in progress, whose listeners may use this port.
    for (auto& connector : removed) {
        connector->disconnect();
        ConnectorInfo info = connector->profile();
        m_listeners.notify(ConnectorListenerType::ON_DISCONNECT, info);
    }
}

std::shared_ptr<PullBuffer> OutPortBase::pullBuffer(const char* connector_id) {
    auto* connector = dynamic_cast<OutPortPullConnector*>(getConnectorById(connector_id));
    return connector ? connector->pull_buffer() : nullptr;
}

void OutPortBase::dropLostConnections(const std::vector<std::string>& connector_ids) {
    for (const auto& id : connector_ids) dropLostConnection(id.c_str());
}

OutPortBase::FastPath OutPortBase::writeFastPath(const Marshal& marshal) {
    auto& mutex = short_mutex(m_dataMutex);
    if (!mutex.lock_unless_rehearsing()) return FastPath::accepted;
    const tandem::rt::ShortLock lock(mutex, std::adopt_lock);
    DataPortStatus status;
    OutPortPushConnector* const connector = m_fastPath.load(std::memory_order_relaxed);
    if (connector == nullptr || !connector->writeInPlace(marshal, status)) [[unlikely]]
        return tandem::rt::rehearsing() ? FastPath::accepted : FastPath::none;
    if (!tandem::rt::rehearsing()) [[likely]]
        m_status[0] = status;
    return status == DataPortStatus::PORT_OK ? FastPath::accepted : FastPath::refused;
}

void OutPortBase::rehearseWrite(const Marshal& marshal) {
    auto& mutex = short_mutex(m_dataMutex);
    if (!mutex.lock_if_owner()) return;
    const tandem::rt::ShortLock lock(mutex, std::adopt_lock);
    for (auto* connector : m_connectors)
        if (auto* push = dynamic_cast<OutPortPushConnector*>(connector)) push->rehearse(marshal);
}

void OutPortBase::findFastPath() { m_fastPath = dynamic_cast<OutPortPushConnector*>(m_connectors.front()); }

void OutPortBase::activateInterfaces() {}
void OutPortBase::deactivateInterfaces() {}

} // namespace RTC
