// SPDX-License-Identifier: Apache-2.0
// PeriodicECSharedComposite: its members lend themselves to its execution context.
#include "host/rtm/runtime/sdo/shared_composite.hpp"
#include "host/rtm/runtime/sdo/organization.hpp"
#include <algorithm>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/Manager.h>
#include <rtm/PeriodicECSharedComposite.h>

namespace SDOPackage {

PeriodicECOrganization::PeriodicECOrganization(RTC::RTObject_impl* composite, SDOSystemElement_ptr owner)
    : Organization_impl(owner), rtclog("composite"), m_rtobj(composite) {}
PeriodicECOrganization::~PeriodicECOrganization() = default;

CORBA::Boolean PeriodicECOrganization::add_members(const SDOList& sdos) {
    SDOList taken;
    for (CORBA::ULong i = 0; i < sdos.length(); ++i) {
        RTC::RTObject_var member = RTC::RTObject::_narrow(sdos[i]);
        if (CORBA::is_nil(member.in()) || !takeIn(member.in())) continue;
        SDO_var one = SDO::_duplicate(sdos[i]);
        CORBA_SeqUtil::push_back(taken, one);
    }
    return Organization_impl::add_members(taken) && taken.length() == sdos.length();
}

CORBA::Boolean PeriodicECOrganization::set_members(const SDOList& sdos) {
    removeAllMembers();
    return add_members(sdos);
}

CORBA::Boolean PeriodicECOrganization::remove_member(const char* id) {
    SDOList_var present = get_members();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        CORBA::String_var one = present[i]->get_sdo_id();
        if (std::string(id) != one.in()) continue;
        RTC::RTObject_var member = RTC::RTObject::_narrow(present[i]);
        if (!CORBA::is_nil(member.in())) letGo(member.in());
    }
    return Organization_impl::remove_member(id);
}

void PeriodicECOrganization::removeAllMembers() {
    SDOList_var present = get_members();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        try {
            CORBA::String_var id = present[i]->get_sdo_id();
            remove_member(id.in());
        } catch (const CORBA::Exception& e) {
            RTC_WARN(("a member of %s cannot be reached: %s", m_rtobj->getInstanceName(), e._name()));
        }
    }
}

void PeriodicECOrganization::updateDelegatedPorts() {
    SDOList_var present = get_members();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        RTC::RTObject_var member = RTC::RTObject::_narrow(present[i]);
        if (!CORBA::is_nil(member.in())) exportPortsOf(member.in(), true);
    }
}

void PeriodicECOrganization::forAllMembers(
    RTC::ReturnCode_t (RTC::ExecutionContextBase::*request)(RTC::LightweightRTObject_ptr)) {
    SDOList_var present = get_members();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        RTC::RTObject_var member = RTC::RTObject::_narrow(present[i]);
        if (!CORBA::is_nil(member.in())) (context().*request)(member.in());
    }
}

RTC::ExecutionContextBase& PeriodicECOrganization::context() { return *m_rtobj->getOwnContexts().at(0); }

void PeriodicECOrganization::runOwnContexts(RTC::RTObject_ptr member, bool run) {
    RTC::ExecutionContextList_var own = member->get_owned_contexts();
    for (CORBA::ULong i = 0; i < own->length(); ++i) run ? own[i]->start() : own[i]->stop();
}

bool PeriodicECOrganization::takeIn(RTC::RTObject_ptr member) {
    if (m_rtobj->getOwnContexts().empty()) return false;
    runOwnContexts(member, false);
    Configuration_var configuration = member->get_configuration();
    configuration->add_organization(Organization_var(getObjRef()).in());
    if (context().addComponent(member) != RTC::RTC_OK) {
        CORBA::String_var id = member->get_sdo_id();
        RTC_ERROR(("%s cannot take part in the context of %s", id.in(), m_rtobj->getInstanceName()));
        runOwnContexts(member, true);
        return false;
    }
    exportPortsOf(member, true);
    return true;
}

void PeriodicECOrganization::letGo(RTC::RTObject_ptr member) {
    exportPortsOf(member, false);
    // Within a cycle the deactivation is only asked for; the member leaves when it is done.
    if (context().getComponentState(member) == RTC::ACTIVE_STATE) context().deactivateComponent(member);
    if (context().getComponentState(member) == RTC::ERROR_STATE) context().resetComponent(member);
    context().removeComponent(member);
    Configuration_var configuration = member->get_configuration();
    configuration->remove_organization(id_.c_str());
    runOwnContexts(member, true);
}

void PeriodicECOrganization::exportPortsOf(RTC::RTObject_ptr member, bool is_member) {
    auto wanted = coil::split(m_rtobj->getProperties().getProperty("conf.default.exported_ports"), ",", true);
    RTC::PortServiceList_var ports = member->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        RTC::PortProfile_var profile = ports[i]->get_port_profile();
        const std::string name(profile->name);
        const bool exported = is_member && std::find(wanted.begin(), wanted.end(), name) != wanted.end();
        if (exported)
            m_rtobj->addPort(ports[i]);
        else
            m_rtobj->removePort(ports[i]);
    }
}

} // namespace SDOPackage

namespace RTC {
namespace {

bool to_names(std::vector<std::string>& names, const char* text) {
    names = coil::split(coil::replaceString(text, "|", ""), ",", true);
    return true;
}

struct PortsChanged : ConfigurationSetListener {
    explicit PortsChanged(SDOPackage::PeriodicECOrganization& o) : organization(o) {}
    void operator()(const coil::Properties&) override { organization.updateDelegatedPorts(); }
    SDOPackage::PeriodicECOrganization& organization;
};

const char* const composite_profile[] = {"implementation_id",
                                         "PeriodicECSharedComposite",
                                         "type_name",
                                         "PeriodicECSharedComposite",
                                         "description",
                                         "components that share one execution context",
                                         "version",
                                         "1.0",
                                         "vendor",
                                         "jp.go.aist",
                                         "category",
                                         "composite.PeriodicECShared",
                                         "activity_type",
                                         "DataFlowComponent",
                                         "max_instance",
                                         "0",
                                         "language",
                                         "C++",
                                         "lang_type",
                                         "compile",
                                         "conf.default.members",
                                         "",
                                         "conf.default.exported_ports",
                                         "",
                                         ""};

} // namespace

void register_shared_composite(Manager& manager) {
    coil::Properties profile(composite_profile);
    manager.registerFactory(profile, Create<PeriodicECSharedComposite>, Delete<PeriodicECSharedComposite>);
}

PeriodicECSharedComposite::PeriodicECSharedComposite(Manager* manager)
    : RTObject_impl(manager),
      m_org(new SDOPackage::PeriodicECOrganization(this, RTObject_var(getObjRef()).in())) {
    m_ownedOrganizations->add(SDOPackage::Organization_var(m_org->getObjRef()).in());
    bindParameter("members", m_members, "", to_names);
    for (const auto type :
         {ConfigurationSetListenerType::ON_SET_CONFIG_SET, ConfigurationSetListenerType::ON_ADD_CONFIG_SET})
        addConfigurationSetListener(type, new PortsChanged(*m_org));
}

PeriodicECSharedComposite::~PeriodicECSharedComposite() {
    m_org->retire();
    m_org->_remove_ref();
}

ReturnCode_t PeriodicECSharedComposite::onInitialize() {
    const std::string active = m_properties.getProperty("configuration.active_config", "default");
    m_configsets.update(m_configsets.haveConfig(active.c_str()) ? active.c_str() : "default");
    SDOPackage::SDOList members;
    for (const auto& name : m_members) {
        RTObject_impl* member = m_pManager->getComponent(coil::eraseBothEndsBlank(name).c_str());
        if (member == nullptr) {
            RTC_ERROR(("member %s: there is no such component; create it before", name.c_str()));
            continue;
        }
        SDOPackage::SDO_var sdo = SDOPackage::SDO::_duplicate(RTObject_var(member->getObjRef()).in());
        CORBA_SeqUtil::push_back(members, sdo);
    }
    return m_org->add_members(members) ? RTC_OK : RTC_ERROR;
}

ReturnCode_t PeriodicECSharedComposite::onActivated(UniqueId) {
    m_org->forAllMembers(&ExecutionContextBase::activateComponent);
    return RTC_OK;
}
ReturnCode_t PeriodicECSharedComposite::onDeactivated(UniqueId) {
    m_org->forAllMembers(&ExecutionContextBase::deactivateComponent);
    return RTC_OK;
}
ReturnCode_t PeriodicECSharedComposite::onReset(UniqueId) {
    m_org->forAllMembers(&ExecutionContextBase::resetComponent);
    return RTC_OK;
}
ReturnCode_t PeriodicECSharedComposite::onFinalize() {
    m_org->removeAllMembers();
    return RTC_OK;
}

} // namespace RTC

void PeriodicECSharedCompositeInit(RTC::Manager* manager) { RTC::register_shared_composite(*manager); }
