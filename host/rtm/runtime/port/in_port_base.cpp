// SPDX-License-Identifier: Apache-2.0
// InPortBase: makes the connectors of an InPort when it is connected, and chooses the one to read from.
#include "host/rt/cycle_lines.hpp"
#include "host/rt/rehearsal.hpp"
#include "host/rtm/runtime/naming/local_object.hpp"
#include "host/rtm/runtime/port/custom_serializer.hpp"
#include "host/rtm/runtime/port/data_mutex.hpp"
#include "host/rtm/runtime/port/remote_port.hpp"
#include "host/rtm/runtime/transport/buffer/port_buffer.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/in_port_connectors.hpp"
#include "host/rtm/runtime/transport/newest/numbered_in_port.hpp"
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include "host/rtm/runtime/transport/ring/ring_in_port.hpp"
#include <rtm/InPortBase.h>
#include <rtm/OutPortBase.h>

namespace RTC {
namespace {

// After this many reads without a message, a component that waits by polling rehearses reading the next one.
constexpr unsigned empty_looks_per_rehearsal = 4096;

// The port that is called publishes its address: the InPort of a push connection, the OutPort of a pull one.
bool is_pull(const coil::Properties& connector_properties) {
    return coil::normalize(connector_properties.getProperty("dataflow_type", "push")) == "pull";
}

// Records the cache lines that a check for a message uses. `members`: of the port.
void note_port(std::initializer_list<const void*> members, const InPortBase::ConnectorList& connectors) {
    using tandem::rt::note_lines;
    for (const void* member : members) note_lines(member, sizeof(void*));
    if (connectors.empty()) return;
    InPortConnector* const connector = connectors.front();
    note_lines(connectors.data(), sizeof(void*));
    note_lines(connector, sizeof *connector);
    if (const auto* buffer = dynamic_cast<const PortBuffer*>(connector->getBuffer())) buffer->note_lines();
}

} // namespace

InPortBase::InPortBase(const char* name, const char* data_type)
    : PortBase(name), m_thebuffer(new PortBuffer) {
    // Tools and peers read these in the port's profile; init() adds the transports of libraries.
    addProperty("port.port_type", "DataInPort");
    addProperty("dataport.data_type", data_type);
    addProperty("dataport.subscription_type", "Any");
    addProperty("dataport.dataflow_type", "push, pull");
    addProperty("dataport.interface_type", "corba_cdr, data_service, direct, shared_memory");
}

InPortBase::~InPortBase() {
    retire(); // first, so that no call from outside reaches the objects that are deleted next
    for (auto* connector : m_connectors) delete connector;
    delete m_thebuffer;
}

void InPortBase::init(coil::Properties& prop) {
    m_properties << prop;
    if (const auto* node = m_properties.findNode("buffer")) m_thebuffer->init(*node);
    {
        const std::lock_guard lock(m_profile_mutex);
        NVUtil::mergeFromProperties(m_profile.properties, m_properties);
        append_registered_types(m_profile.properties, true);
    }
    initConnectionLimit();
}

// Push: the receiver must exist before the OutPort subscribes to it, so its connector is made in this step.
ReturnCode_t InPortBase::publishInterfaces(ConnectorProfile& profile) {
    const ReturnCode_t allowed = _publishInterfaces();
    if (allowed != RTC_OK) return allowed;
    const coil::Properties prop = connector_properties(m_properties, profile, "inport");
    const std::string reason = unsupported_reason(profile, prop, true);
    if (!reason.empty()) return refuse(BAD_PARAMETER, std::string(getName()) + ": " + reason);
    return is_pull(prop) ? RTC_OK : addPushConnector(profile, prop);
}

// Adds the connector of a push connection and writes its address into the profile.
ReturnCode_t InPortBase::addPushConnector(ConnectorProfile& profile, const coil::Properties& prop) {
    ConnectorInfo info = connector_info(profile, prop);
    const std::string type = coil::eraseBothEndsBlank(prop.getProperty("buffer_type", "ring_buffer"));
    const bool owns_buffer = type != "ring_buffer" || !m_singlebuffer;
    CdrBufferBase* buffer = owns_buffer ? CdrBufferFactory::instance().createObject(type) : m_thebuffer;
    if (buffer == nullptr)
        return refuse(BAD_PARAMETER, std::string(getName()) + ": there is no buffer type " + type +
                                         "; add it to RTC::CdrBufferFactory before connecting");
    // The shared buffer keeps its settings unless the connection has buffer settings. Then the last connection decides.
    if (owns_buffer || info.properties.findNode("buffer") != nullptr)
        buffer->init(info.properties.getNode("buffer"));

    // Values stay unserialized only if neither a library's buffer nor a user's serializer needs their bytes.
    const bool is_direct = !owns_buffer && coil::normalize(prop.getProperty("interface_type")) == "direct" &&
                           !uses_custom_serializer(profile);
    const auto direct_buffer = is_direct ? directBuffer() : nullptr;
    if (direct_buffer != nullptr)
        if (const auto* node = info.properties.findNode("buffer")) direct_buffer->init(*node);

    auto connector = std::make_unique<InPortPushConnector>(*this, info, buffer, owns_buffer, direct_buffer);
    const std::string registered = registered_push_type(prop);
    if (!registered.empty()) return addPushProvider(profile, prop, registered, std::move(connector));
    publish_object(profile, address_key(corba_interface_type(prop), "inport"),
                   connector->servant().reference(), connector->servant().ior());
    if (const ServantHolder* numbered = connector->numbered_servant())
        publish_object(profile, numbered_in_port_key, numbered->reference(), numbered->ior());
    if (!is_direct && can_receive_from_ring(prop) && has_remote_port(profile)) {
        const ServantHolder& ring = connector->offer_ring(*this);
        publish_object(profile, ring_in_port_key, ring.reference(), ring.ior());
    }
    addConnector(connector.release());
    return RTC_OK;
}

// Adds a push connector for a library's transport. Its provider publishes the address and writes into the connector.
ReturnCode_t InPortBase::addPushProvider(ConnectorProfile& profile, const coil::Properties& prop,
                                         const std::string& type,
                                         std::unique_ptr<InPortPushConnector> connector) {
    auto provider = create_registered_in_provider(type, prop);
    if (provider == nullptr)
        return refuse(RTC_ERROR, std::string(getName()) + ": interface type " + type +
                                     " has no InPortProvider here; load the library that brings it");
    ConnectorInfo info = connector->profile();
    provider->setListener(info, &m_listeners);
    provider->setBuffer(connector->getBuffer());
    provider->setConnector(connector.get());
    if (!provider->publishInterface(profile.properties))
        return refuse(RTC_ERROR, std::string(getName()) + ": the InPortProvider of interface type " + type +
                                     " publishes nothing");
    connector->set_provider(std::move(provider));
    addConnector(connector.release());
    return RTC_OK;
}

// Pull: the OutPort has published where to fetch from.
ReturnCode_t InPortBase::subscribeInterfaces(const ConnectorProfile& profile) {
    const coil::Properties prop = connector_properties(m_properties, profile, "inport");
    return is_pull(prop) ? addPullConnector(profile, prop) : RTC_OK;
}

ReturnCode_t InPortBase::addPullConnector(const ConnectorProfile& profile, const coil::Properties& prop) {
    ConnectorInfo info = connector_info(profile, prop);
    const std::string registered = registered_pull_type(prop);
    if (!registered.empty()) {
        auto sender = create_registered_sender(registered, profile, info, m_listeners, *m_thebuffer, prop);
        if (sender == nullptr)
            return refuse(RTC_ERROR, std::string(getName()) + ": interface type " + registered +
                                         " has no OutPortConsumer here, or it does not find the other side");
        addConnector(new InPortPullConnector(*this, info, std::move(sender)));
        return RTC_OK;
    }
    // An OutPort of this process shares its buffer, so that reading needs no CORBA call.
    std::vector<std::shared_ptr<PullBuffer>> buffers;
    for (CORBA::ULong i = 0; i < profile.ports.length(); ++i) {
        auto port = local_object<OutPortBase>(profile.ports[i]);
        auto buffer = port ? port->pullBuffer(profile.connector_id) : nullptr;
        if (buffer != nullptr) buffers.push_back(std::move(buffer));
    }
    if (buffers.size() > 1)
        return refuse(BAD_PARAMETER,
                      std::string(getName()) + ": the connection has " + std::to_string(buffers.size()) +
                          " OutPorts to pull from, expected one; connect each OutPort separately");
    if (!buffers.empty()) {
        addConnector(new InPortPullConnector(*this, info, buffers.front()));
        return RTC_OK;
    }
    auto remote = RemoteSender::find(profile, corba_interface_type(prop));
    if (remote == nullptr)
        return refuse(RTC_ERROR, std::string(getName()) + ": the other side offers no " +
                                     corba_interface_type(prop) + " reference to pull from");
    addConnector(new InPortPullConnector(*this, info, std::move(remote)));
    return RTC_OK;
}

// Takes over the connector. The listeners are called without the lock: they may read the port.
void InPortBase::addConnector(InPortConnector* connector) {
    ConnectorInfo info = connector->profile();
    {
        const std::lock_guard lock(m_connectorsMutex);
        const std::lock_guard data_lock(m_dataMutex);
        m_connectors.push_back(connector);
        m_fastPath = nullptr;
    }
    m_listeners.notify(ConnectorListenerType::ON_CONNECT, info);
}

void InPortBase::unsubscribeInterfaces(const ConnectorProfile& profile) {
    std::unique_ptr<InPortConnector> removed;
    {
        const std::lock_guard lock(m_connectorsMutex);
        const std::lock_guard data_lock(m_dataMutex);
        for (auto it = m_connectors.begin(); it != m_connectors.end(); ++it) {
            if (std::string((*it)->id()) != static_cast<const char*>(profile.connector_id)) continue;
            removed.reset(*it);
            m_connectors.erase(it);
            m_fastPath = nullptr;
            break;
        }
    }
    if (!removed) return;
    // Not under the lock: disconnect() waits for messages in progress, whose listeners may be reading this port.
    removed->disconnect();
    ConnectorInfo info = removed->profile();
    m_listeners.notify(ConnectorListenerType::ON_DISCONNECT, info);
}

std::shared_ptr<PushReceiver> InPortBase::pushReceiver(const char* connector_id) {
    auto* connector = dynamic_cast<InPortPushConnector*>(getConnectorById(connector_id));
    return connector ? connector->receiver() : nullptr;
}

InPortConnector* InPortBase::findFirstReadable() {
    for (auto* connector : m_connectors)
        if (connector->readableCount() > 0) return connector;
    return nullptr;
}

InPortConnector* InPortBase::findReadable() {
    {
        const tandem::rt::ShortLock lock(short_mutex(m_dataMutex));
        InPortConnector* const sole = m_fastPath.load(std::memory_order_relaxed);
        if (sole == nullptr) {
            if (InPortConnector* const found = findFirstReadable()) return found;
        } else if (!sole->getBuffer()->empty()) {
            return sole;
        }
    }
    return findNothing();
}

InPortConnector* InPortBase::findNothing() {
    if (++m_emptyLooks % empty_looks_per_rehearsal == 0) [[unlikely]]
        rehearse();
    return nullptr;
}

bool InPortBase::readFastPath(Unmarshal& reader) {
    auto& mutex = short_mutex(m_dataMutex);
    if (!mutex.lock_unless_rehearsing()) return false;
    const tandem::rt::ShortLock lock(mutex, std::adopt_lock);
    InPortConnector* const connector = m_fastPath.load(std::memory_order_relaxed);
    if (connector != nullptr && !tandem::rt::rehearsing()) [[likely]]
        return connector->readInPlace(reader, m_status[0]);
    if (tandem::rt::this_thread_lines != nullptr)
        note_port({this, &m_dataMutex, &m_connectors, &m_fastPath}, m_connectors);
    DataPortStatus ignored;
    return connector != nullptr && connector->readInPlace(reader, ignored);
}

InPortConnector* InPortBase::findReadableLocked(const std::string& name, bool fallback_to_first) {
    InPortConnector* first = nullptr;
    for (auto* connector : m_connectors) {
        if (!name.empty() && name != connector->name()) continue;
        if (first == nullptr) first = connector;
        // A single connector is returned in any case. Reading it shows whether it has data, which saves a check here.
        if (fallback_to_first && m_connectors.size() == 1) return first;
        if (connector->readableCount() > 0) return connector;
    }
    if (!fallback_to_first) return nullptr;
    // Only a request shows whether a sender in another process has a message. All senders are asked, because the first
    // may be empty, hang or be dead. Only the failure of the first is kept, as the result of reading the port.
    for (auto* connector : m_connectors) {
        if (!name.empty() && name != connector->name()) continue;
        auto* pull = dynamic_cast<InPortPullConnector*>(connector);
        if (pull != nullptr && pull->prefetch(connector == first)) return connector;
    }
    return first;
}

// A port without a type cannot stamp; InPort<T> does.
void InPortBase::stampOnReceive(ByteData&) {}
void InPortBase::activateInterfaces() {}
void InPortBase::deactivateInterfaces() {}

} // namespace RTC
