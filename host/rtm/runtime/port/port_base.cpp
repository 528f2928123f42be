// SPDX-License-Identifier: Apache-2.0
// A port as a CORBA object: identity, profile, list of connection profiles. How it is connected is in
// port_connect.cpp.
#include "host/process/published/inventory.hpp"
#include "host/rt/rehearsal.hpp"
#include "host/rtm/runtime/port/listed_port.hpp"
#include "host/rtm/runtime/transport/out_port_connectors.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include <chrono>
#include <coil/UUID.h>
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/InPortBase.h>
#include <rtm/Manager.h>
#include <rtm/NVUtil.h>
#include <rtm/OutPortBase.h>
#include <rtm/PortBase.h>
#include <string_view>
#include <thread>

namespace RTC {
namespace {

/// Waits up to 1 s until the ORB gives up its reference to a deactivated servant, which it does when the last
/// call from outside has returned. A port is a member of its component and is destroyed with it, so calls
/// must have left it before. The wait is bounded because the call may itself wait for this thread.
void wait_for_calls_to_end(PortableServer::ServantBase& servant) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    while (servant._refcount_value() > 1 && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

} // namespace

// The port is a CORBA object from here on, though nobody outside knows it before it has an owner.
PortBase::PortBase(const char* name) : rtclog(name), m_poa(Manager::instance().getPOA()) {
    m_objref = this->_this();
    m_oid = m_poa->servant_to_id(this);
    m_profile.name = CORBA::string_dup(name);
    m_profile.port_ref = RTC::PortService::_duplicate(m_objref.in());
    m_profile.owner = RTC::RTObject::_nil();
}

PortBase::~PortBase() { retire(); }

void PortBase::retire() {
    tandem::process::unlist_part(this);
    if (m_retired) return;
    m_retired = true;
    set_servant_owner(this, nullptr);
    try {
        m_poa->deactivate_object(m_oid.in());
        wait_for_calls_to_end(*this);
    } catch (const CORBA::Exception&) {
        // The ORB was shut down first: nothing is left to deactivate.
    }
}

// CORBA's C++ mapping: the caller deletes what the get_...() operations return.
PortProfile* PortBase::get_port_profile() {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    return new PortProfile(m_profile);
}

PortProfile PortBase::profileWithoutConnections() const {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    PortProfile profile;
    profile.name = m_profile.name;
    profile.interfaces = m_profile.interfaces;
    profile.port_ref = m_profile.port_ref;
    profile.owner = m_profile.owner;
    profile.properties = m_profile.properties;
    return profile;
}

ConnectorProfileList* PortBase::get_connector_profiles() {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    return new ConnectorProfileList(m_profile.connector_profiles);
}

// With `dataport.report_unread: YES`, the connection's profile also contains `dataport.unread`: how many messages an
// InPort has not read. Without a connection no component sees these messages. The number is unknown for an InPort with
// several connections, because they share a buffer.
// With `dataport.report_lost: YES`, the profile of an OutPort contains `dataport.lost`: how many messages its buffer
// has lost. It also contains `dataport.undelivered`: how many of the messages to another machine have not arrived, or
// not yet (Tandem only).
ConnectorProfile* PortBase::get_connector_profile(const char* connector_id) {
    ConnectorProfile_var profile = new ConnectorProfile(findConnProfile(connector_id));
    if (auto* out_port = dynamic_cast<OutPortBase*>(this);
        out_port != nullptr && NVUtil::isStringValue(profile->properties, "dataport.report_lost", "YES")) {
        const std::lock_guard lock(m_connectorsMutex);
        for (auto* connector : out_port->connectors())
            if (auto* push = dynamic_cast<OutPortPushConnector*>(connector);
                push != nullptr && std::string_view(connector->id()) == connector_id)
                for (const auto& [key, count] : {std::pair("dataport.lost", push->lost()),
                                                 std::pair("dataport.undelivered", push->undelivered())})
                    CORBA_SeqUtil::push_back(profile->properties,
                                             NVUtil::newNV(key, std::to_string(count).c_str()));
        return profile._retn();
    }
    auto* in_port = dynamic_cast<InPortBase*>(this);
    if (in_port == nullptr || !NVUtil::isStringValue(profile->properties, "dataport.report_unread", "YES"))
        return profile._retn();
    const std::lock_guard lock(m_dataMutex); // the component reads with this mutex, too
    for (auto* connector : in_port->connectors())
        if (in_port->connectors().size() == 1 && connector->getBuffer() != nullptr)
            CORBA_SeqUtil::push_back(
                profile->properties,
                NVUtil::newNV("dataport.unread", std::to_string(connector->readableCount()).c_str()));
    return profile._retn();
}

void PortBase::rehearse() {
    const tandem::rt::Rehearsal rehearsal;
    rehearseMessage();
}

void PortBase::setName(const char* name) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    m_profile.name = CORBA::string_dup(name);
    rtclog.setName(name);
}

void PortBase::setPortRef(PortService_ptr port_ref) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    m_profile.port_ref = RTC::PortService::_duplicate(port_ref);
}

PortService_ptr PortBase::getPortRef() const {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    return RTC::PortService::_duplicate(m_profile.port_ref);
}

void PortBase::setOwner(RTObject_ptr owner) {
    RTC::ComponentProfile_var profile = owner->get_component_profile();
    setOwner(owner, profile->instance_name);
}

void PortBase::setOwner(RTObject_ptr owner, const char* instance_name) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    // The port may have had an owner: only what follows the last dot is its own name.
    const std::string former(m_profile.name);
    const std::string name = std::string(instance_name) + "." + former.substr(former.rfind('.') + 1);
    m_ownerInstanceName = instance_name;
    m_profile.owner = RTC::RTObject::_duplicate(owner);
    m_profile.name = CORBA::string_dup(name.c_str());
    list_port(this, m_profile);
    rtclog.setName(name.c_str());
}

std::string PortBase::connectError() const {
    std::lock_guard<std::mutex> lock(m_errorMutex);
    return m_connectError;
}

// A separate mutex, because connect() may be refused while another thread reads the profile.
ReturnCode_t PortBase::refuse(ReturnCode_t code, const std::string& reason) {
    RTC_DEBUG(("%s", reason.c_str()));
    std::lock_guard<std::mutex> lock(m_errorMutex);
    m_connectError = reason;
    return code;
}

ReturnCode_t PortBase::clearConnectError() {
    std::lock_guard<std::mutex> lock(m_errorMutex);
    m_connectError.clear();
    return RTC_OK;
}

bool PortBase::isEmptyId(const ConnectorProfile& profile) { return profile.connector_id[0] == '\0'; }

// Connection ids must be unique among all processes.
std::string PortBase::getUUID() { return coil::UUID_Generator().generateUUID()->to_string(); }

void PortBase::setUUID(ConnectorProfile& profile) {
    profile.connector_id = CORBA::string_dup(getUUID().c_str());
}

bool PortBase::isExistingConnId(const char* id) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    return findConnProfileIndex(id) >= 0;
}

// The caller holds m_profile_mutex.
CORBA::Long PortBase::findConnProfileIndex(const char* id) const {
    return CORBA_SeqUtil::find(m_profile.connector_profiles,
                               [id](const ConnectorProfile& p) { return std::string(p.connector_id) == id; });
}

// Returns a copy, because another thread may erase the profile. The copy is empty, without ports, if there is no
// profile.
ConnectorProfile PortBase::findConnProfile(const char* id) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    const CORBA::Long index = findConnProfileIndex(id);
    return index < 0 ? ConnectorProfile() : m_profile.connector_profiles[static_cast<CORBA::ULong>(index)];
}

// Adds the profile of a new connection, or replaces the one of the same id.
void PortBase::updateConnectorProfile(const ConnectorProfile& profile) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    const CORBA::Long index = findConnProfileIndex(profile.connector_id);
    if (index < 0)
        CORBA_SeqUtil::push_back(m_profile.connector_profiles, profile);
    else
        m_profile.connector_profiles[static_cast<CORBA::ULong>(index)] = profile;
    list_port(this, m_profile);
}

bool PortBase::eraseConnectorProfile(const char* id) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    const CORBA::Long index = findConnProfileIndex(id);
    if (index < 0) return false;
    CORBA_SeqUtil::erase(m_profile.connector_profiles, static_cast<CORBA::ULong>(index));
    list_port(this, m_profile);
    return true;
}

// Returns false if the port already has an interface of that name and polarity, because the profile could not
// distinguish them.
bool PortBase::appendInterface(const char* instance_name, const char* type_name,
                               PortInterfacePolarity polarity) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    auto same = [&](const PortInterfaceProfile& p) {
        return p.polarity == polarity && std::string(p.instance_name) == instance_name;
    };
    if (CORBA_SeqUtil::find(m_profile.interfaces, same) >= 0) return false;
    PortInterfaceProfile profile;
    profile.instance_name = CORBA::string_dup(instance_name);
    profile.type_name = CORBA::string_dup(type_name);
    profile.polarity = polarity;
    CORBA_SeqUtil::push_back(m_profile.interfaces, profile);
    list_port(this, m_profile);
    return true;
}

bool PortBase::deleteInterface(const char* name, PortInterfacePolarity polarity) {
    std::lock_guard<std::mutex> lock(m_profile_mutex);
    const CORBA::Long index = CORBA_SeqUtil::find(m_profile.interfaces, [&](const PortInterfaceProfile& p) {
        return p.polarity == polarity && std::string(p.instance_name) == name;
    });
    if (index < 0) return false;
    CORBA_SeqUtil::erase(m_profile.interfaces, static_cast<CORBA::ULong>(index));
    list_port(this, m_profile);
    return true;
}

} // namespace RTC
