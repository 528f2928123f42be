// SPDX-License-Identifier: Apache-2.0
// A component's ports, profile, properties and action listeners. OpenRTM-aist: RTObject_impl and PortAdmin.
// A port gets the settings `port.inport.NAME.*` (outport, corbaport), and below them those of all ports of its
// kind, `port.inport.dataport.*` or `port.corba.*`.
#include "host/process/published/inventory.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include <rtm/RTObject.h>
#include <typeinfo>

namespace RTC {
namespace {

// Announces an added port after the port has its settings, because a listener may connect it. Always returns true, for
// convenience of the callers.
template <class Listeners>
bool notify(Listeners& listeners, const PortProfile& profile) {
    listeners.forEach([&](auto& listener) { listener(profile); });
    return true;
}

} // namespace

// The caller owns the profile. Built at each call, because ports and properties change.
ComponentProfile* RTObject_impl::get_component_profile() {
    ComponentProfile_var profile = new ComponentProfile(m_profile);
    NVUtil::copyFromProperties(profile->properties, m_properties);
    profile->port_profiles = m_portAdmin.getPortProfileList();
    return profile._retn();
}

PortServiceList* RTObject_impl::get_ports() { return m_portAdmin.getPortServiceList(); }

void RTObject_impl::setInstanceName(const char* instance_name) {
    m_properties["instance_name"] = instance_name;
    m_profile.instance_name = CORBA::string_dup(instance_name);
    rtclog.setName(instance_name);
    set_servant_owner(this, std::make_shared<ServantOwner>(ServantOwner{instance_name, &typeid(*this)}));
}

std::vector<std::string> RTObject_impl::getNamingNames() {
    return coil::split(m_properties.getProperty("naming.names"), ",");
}

void RTObject_impl::setObjRef(RTObject_ptr rtobj) { m_objref = RTC::RTObject::_duplicate(rtobj); }

// Merges; the profile that tools read is derived from the properties.
void RTObject_impl::setProperties(const coil::Properties& prop) {
    m_properties << prop;
    auto text = [this](const char* key) { return CORBA::string_dup(m_properties.getProperty(key).c_str()); };
    m_profile.instance_name = text("instance_name");
    m_profile.type_name = text("type_name");
    m_profile.description = text("description");
    m_profile.version = text("version");
    m_profile.vendor = text("vendor");
    m_profile.category = text("category");
    rtclog.setName(m_profile.instance_name);
}

// The common part for all kinds of ports. Returns false if the component already has a port of that name.
bool RTObject_impl::addNamed(const char* name, PortBase& port) {
    auto owner = std::make_shared<ServantOwner>(ServantOwner{getInstanceName(), &typeid(*this), name});
    // The owner's name becomes part of the port's full name (`Component.port`).
    port.setOwner(m_objref.in(), m_profile.instance_name);
    set_servant_owner(&port, std::move(owner));
    if (m_portAdmin.addPort(port)) {
        port.setPortConnectListenerHolder(&m_portConnectListeners);
        return true;
    }
    if (m_portAdmin.getPort(port.getName()) != &port) tandem::process::unlist_part(&port);
    RTC_ERROR(("there is already a port %s; the second one is not added", name));
    return false;
}

bool RTObject_impl::addPort(PortBase& port) {
    return addNamed(port.getName(), port) &&
           notify(m_actionListeners.portaction_[0], port.profileWithoutConnections());
}

bool RTObject_impl::addPort(CorbaPort& port) {
    const std::string name(port.getName());
    coil::Properties& node = m_properties.getNode("port.corbaport." + name.substr(name.rfind('.') + 1));
    if (const auto* common = m_properties.findNode("port.corba")) node << *common;
    port.init(node);
    return addNamed(name.c_str(), port) &&
           notify(m_actionListeners.portaction_[0], port.profileWithoutConnections());
}

// Returns false if the component already has a port of that name.
bool RTObject_impl::addInPort(const char* name, InPortBase& inport) {
    coil::Properties& node = m_properties.getNode(std::string("port.inport.") + name);
    if (const auto* common = m_properties.findNode("port.inport.dataport")) node << *common;
    if (!addNamed(name, inport)) return false;
    inport.init(node);
    m_inports.push_back(&inport);
    return notify(m_actionListeners.portaction_[0], inport.profileWithoutConnections());
}

bool RTObject_impl::addOutPort(const char* name, OutPortBase& outport) {
    coil::Properties& node = m_properties.getNode(std::string("port.outport.") + name);
    if (const auto* common = m_properties.findNode("port.outport.dataport")) node << *common;
    if (!addNamed(name, outport)) return false;
    outport.init(node);
    m_outports.push_back(&outport);
    return notify(m_actionListeners.portaction_[0], outport.profileWithoutConnections());
}

// Ports of other components, which a composite shows as its own.
bool RTObject_impl::addPort(PortService_ptr port) {
    return m_portAdmin.addPort(port) &&
           notify(m_actionListeners.portaction_[0], PortProfile_var(port->get_port_profile()).in());
}
bool RTObject_impl::removePort(PortService_ptr port) {
    return m_portAdmin.removePort(port) &&
           notify(m_actionListeners.portaction_[1], PortProfile_var(port->get_port_profile()).in());
}

bool RTObject_impl::removeInPort(InPortBase& port) {
    std::erase(m_inports, &port);
    return removePort(static_cast<PortBase&>(port));
}
bool RTObject_impl::removeOutPort(OutPortBase& port) {
    std::erase(m_outports, &port);
    return removePort(static_cast<PortBase&>(port));
}

// Ports that are in neither list are service ports. Connections are ended by PortAdmin.
bool RTObject_impl::removePort(PortBase& port) {
    std::erase_if(m_inports, [&](InPortBase* p) { return static_cast<PortBase*>(p) == &port; });
    std::erase_if(m_outports, [&](OutPortBase* p) { return static_cast<PortBase*>(p) == &port; });
    if (!m_portAdmin.removePort(port)) return false;
    port.setPortConnectListenerHolder(nullptr); // the port may outlive the component
    return notify(m_actionListeners.portaction_[1], port.profileWithoutConnections());
}

void RTObject_impl::deletePortByName(const char* port_name) {
    if (PortBase* port = m_portAdmin.getPort(port_name)) removePort(*port);
}

// Defines addKIND() and removeKIND() of one kind of listener.
#define TANDEM_ACTION_LISTENERS(Kind, table)                                                                 \
    void RTObject_impl::add##Kind(Kind##Type type, Kind* listener, bool autoclean) {                         \
        m_actionListeners.table.at(m_actionListeners.at(type)).addListener(listener, autoclean);             \
    }                                                                                                        \
    void RTObject_impl::remove##Kind(Kind##Type type, Kind* listener) {                                      \
        m_actionListeners.table.at(m_actionListeners.at(type)).removeListener(listener);                     \
    }
TANDEM_ACTION_LISTENERS(PreComponentActionListener, preaction_)
TANDEM_ACTION_LISTENERS(PostComponentActionListener, postaction_)
TANDEM_ACTION_LISTENERS(PortActionListener, portaction_)
TANDEM_ACTION_LISTENERS(ExecutionContextActionListener, ecaction_)

} // namespace RTC
