// SPDX-License-Identifier: Apache-2.0
// A composite whose members run in its execution context, one after the other, instead of their own. OpenRTM-aist:
// classes PeriodicECSharedComposite and PeriodicECOrganization. Members may be in other processes: they are
// called through CORBA only.
#include "host/rtm/runtime/sdo/shared_composite.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/sdo/organization.hpp"
#include <algorithm>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/Manager.h>
#include <rtm/PeriodicECSharedComposite.h>

namespace SDOPackage {
namespace {

bool contains(const std::vector<RTC::RTObject_var>& all, SDO_ptr sdo) {
    return std::any_of(all.begin(), all.end(), [&](auto& present) { return present->_is_equivalent(sdo); });
}

void add_members_of(RTC::RTObject_ptr component, std::vector<RTC::RTObject_var>& all) {
    OrganizationList_var organizations = component->get_owned_organizations();
    for (CORBA::ULong o = 0; o < organizations->length(); ++o) {
        SDOList_var members = organizations[o]->get_members();
        for (CORBA::ULong m = 0; m < members->length(); ++m) {
            RTC::RTObject_var member = RTC::RTObject::_narrow(members[m]);
            if (!CORBA::is_nil(member.in()) && !contains(all, member.in())) all.push_back(member);
        }
    }
}

// Returns the component and, if it is a composite, the members of its organizations at any depth, each once. Another
// process may tell of new members without end.
std::vector<RTC::RTObject_var> with_members(RTC::RTObject_ptr component) {
    constexpr std::size_t max_asked = 256;
    std::vector<RTC::RTObject_var> all{RTC::RTObject_var(RTC::RTObject::_duplicate(component))};
    for (std::size_t i = 0; i < std::min(all.size(), max_asked); ++i) {
        try {
            const RTC::RTObject_var next = all[i];
            add_members_of(next.in(), all);
        } catch (const CORBA::Exception&) {
            continue; // the process of a member has ended, or it has no organizations
        }
    }
    return all;
}

bool has_member(Organization_impl& organization, SDO_ptr sdo) {
    SDOList_var members = organization.get_members();
    return CORBA_SeqUtil::find(members.in(), [&](SDO_ptr member) { return member->_is_equivalent(sdo); }) >=
           0;
}

// The process of a composite that this one is a member of may have ended.
bool is_alive(RTC::ExecutionContext_ptr context) {
    try {
        return !context->_non_existent();
    } catch (const CORBA::SystemException&) {
        return false;
    }
}

// Returns the context that the composite's members share. Behind it come those of the composites that it is a member of.
std::vector<RTC::ExecutionContext_var> contexts_of(RTC::RTObject_impl& composite) {
    std::vector<RTC::ExecutionContext_var> all;
    RTC::ExecutionContextList_var own = composite.get_owned_contexts();
    if (own->length() == 0) return all;
    all.emplace_back(RTC::ExecutionContext::_duplicate(own[0]));
    RTC::ExecutionContextList_var others = composite.get_participating_contexts();
    for (CORBA::ULong i = 0; i < others->length(); ++i)
        if (is_alive(others[i])) all.emplace_back(RTC::ExecutionContext::_duplicate(others[i]));
    return all;
}

bool takes_part(RTC::ExecutionContext_ptr context, RTC::RTObject_ptr component) {
    return context->get_component_state(component) != RTC::CREATED_STATE;
}

bool join_context(RTC::ExecutionContext_ptr context, RTC::RTObject_ptr component) {
    try {
        return takes_part(context, component) || context->add_component(component) == RTC::RTC_OK;
    } catch (const CORBA::SystemException&) {
        return false;
    }
}

// A callback within a cycle of the context only requests these transitions. The component is then still active, and
// remove_component() refuses it.
void leave_context(RTC::ExecutionContext_ptr context, RTC::RTObject_ptr component) {
    try {
        if (context->get_component_state(component) == RTC::ACTIVE_STATE)
            context->deactivate_component(component);
        if (context->get_component_state(component) == RTC::ERROR_STATE) context->reset_component(component);
        context->remove_component(component);
    } catch (const CORBA::SystemException&) {
        return; // the process of the context has just ended; the others continue
    }
}

} // namespace

PeriodicECOrganization::PeriodicECOrganization(RTC::RTObject_impl* composite, SDOSystemElement_ptr owner)
    : Organization_impl(owner), rtclog("composite"), m_rtobj(composite) {}
PeriodicECOrganization::~PeriodicECOrganization() = default;

// Returns true if all have become members. Logs and leaves out those that cannot.
CORBA::Boolean PeriodicECOrganization::add_members(const SDOList& sdos) {
    bool all = true;
    for (CORBA::ULong i = 0; i < sdos.length(); ++i) {
        RTC::RTObject_var member = RTC::RTObject::_narrow(sdos[i]);
        if (CORBA::is_nil(member.in()) || !attachMember(member.in())) {
            all = false;
            continue;
        }
        SDOList one;
        one.length(1);
        one[0] = SDO::_duplicate(sdos[i]);
        Organization_impl::add_members(one);
    }
    return all;
}

CORBA::Boolean PeriodicECOrganization::set_members(const SDOList& sdos) {
    removeAllMembers();
    return add_members(sdos);
}

// Throws InvalidParameter if there is no member of that id.
CORBA::Boolean PeriodicECOrganization::remove_member(const char* id) {
    SDOList_var present = get_members();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        CORBA::String_var member_id = present[i]->get_sdo_id();
        if (std::string(id) != member_id.in()) continue;
        RTC::RTObject_var member = RTC::RTObject::_narrow(present[i]);
        if (!CORBA::is_nil(member.in())) detachMember(member.in());
    }
    return Organization_impl::remove_member(id);
}

// Continues after an unreachable member, whose process may have ended.
void PeriodicECOrganization::removeAllMembers() {
    SDOList_var present = get_members();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        try {
            CORBA::String_var id = present[i]->get_sdo_id();
            remove_member(id.in());
        } catch (const CORBA::Exception& e) {
            RTC_WARN(("%s: a member cannot be reached and stays in the list: CORBA exception %s",
                      m_rtobj->getInstanceName(), e._name()));
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

// Requests a transition of every member in the composite's context, and of the members of a member that is a composite:
// its own context is stopped.
void PeriodicECOrganization::forAllMembers(
    RTC::ReturnCode_t (RTC::ExecutionContextBase::*request)(RTC::LightweightRTObject_ptr)) {
    SDOList_var present = get_members();
    for (CORBA::ULong i = 0; i < present->length(); ++i) {
        RTC::RTObject_var member = RTC::RTObject::_narrow(present[i]);
        if (CORBA::is_nil(member.in())) continue;
        for (const auto& component : with_members(member.in())) (context().*request)(component.in());
    }
}

// The composite's first own context is the one that its members share.
RTC::ExecutionContextBase& PeriodicECOrganization::context() { return *m_rtobj->getOwnContexts().at(0); }

// Starts or stops the member's own contexts.
void PeriodicECOrganization::runOwnContexts(RTC::RTObject_ptr member, bool run) {
    RTC::ExecutionContextList_var own = member->get_owned_contexts();
    for (CORBA::ULong i = 0; i < own->length(); ++i) {
        if (run)
            own[i]->start();
        else
            own[i]->stop();
    }
}

// Stops the member's own contexts before the member joins this context, so that it never runs in both at once. The
// members of a member that is a composite join, too.
bool PeriodicECOrganization::attachMember(RTC::RTObject_ptr member) {
    const auto refuse = [&](const char* why) {
        CORBA::String_var id = member->get_sdo_id();
        RTC_ERROR(("%s cannot join composite %s: %s", id.in(), m_rtobj->getInstanceName(), why));
        return false;
    };
    const auto contexts = contexts_of(*m_rtobj);
    const auto joining = with_members(member);
    if (contexts.empty()) return refuse("the composite has no execution context");
    if (contains(joining, RTC::RTObject_var(m_rtobj->getObjRef()).in()))
        return refuse("the composite is one of its members");
    if (has_member(*this, member)) return refuse("it is already a member");
    runOwnContexts(member, false);
    Configuration_var configuration = member->get_configuration();
    configuration->add_organization(Organization_var(getObjRef()).in());
    for (const auto& component : joining)
        for (const auto& shared : contexts)
            if (!join_context(shared.in(), component.in())) {
                detachMember(member);
                return refuse("its execution context does not accept it");
            }
    exportPortsOf(member, true);
    return true;
}

// The reverse of attachMember().
void PeriodicECOrganization::detachMember(RTC::RTObject_ptr member) {
    exportPortsOf(member, false);
    for (const auto& shared : contexts_of(*m_rtobj))
        for (const auto& component : with_members(member)) leave_context(shared.in(), component.in());
    Configuration_var configuration = member->get_configuration();
    configuration->remove_organization(id_.c_str());
    runOwnContexts(member, true);
}

// Adds the ports of a member that conf.default.exported_ports names (`Member.port`) to the composite's own
// ports, and removes those that it does not name any more.
void PeriodicECOrganization::exportPortsOf(RTC::RTObject_ptr member, bool is_member) {
    auto exported_names =
        coil::split(m_rtobj->getProperties().getProperty("conf.default.exported_ports"), ",", true);
    RTC::PortServiceList_var ports = member->get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i) {
        RTC::PortProfile_var profile = ports[i]->get_port_profile();
        const std::string name(profile->name);
        const bool exported = is_member && std::find(exported_names.begin(), exported_names.end(), name) !=
                                               exported_names.end();
        if (exported)
            m_rtobj->addPort(ports[i]);
        else
            m_rtobj->removePort(ports[i]);
    }
}

} // namespace SDOPackage

namespace RTC {
namespace {

// `A,B`; older configurations write `|A|,|B|`.
bool parse_names(std::vector<std::string>& names, const char* text) {
    names = coil::split(coil::replaceString(text, "|", ""), ",", true);
    return true;
}

// A misspelt name would leave out a port without notice. Members that join later may bring more ports.
void warn_about_missing_ports(RTObject_impl& composite) {
    coil::vstring present;
    PortServiceList_var ports = composite.get_ports();
    for (CORBA::ULong i = 0; i < ports->length(); ++i)
        present.emplace_back(PortProfile_var(ports[i]->get_port_profile())->name);
    for (const auto& name :
         coil::split(composite.getProperties().getProperty("conf.default.exported_ports"), ",", true))
        if (std::find(present.begin(), present.end(), name) == present.end())
            warn_about_setting(composite.getInstanceName(),
                               "exported_ports names " + name +
                                   ", which is not a port of a member; expected Member.port");
}

// Follows changes of exported_ports by tools.
struct ExportedPortsListener : ConfigurationSetListener {
    explicit ExportedPortsListener(SDOPackage::PeriodicECOrganization& o) : organization(o) {}
    void operator()(const coil::Properties&) override { organization.updateDelegatedPorts(); }
    SDOPackage::PeriodicECOrganization& organization;
};

coil::Properties composite_profile() {
    const char* const spec[][2] = {{"implementation_id", "PeriodicECSharedComposite"},
                                   {"type_name", "PeriodicECSharedComposite"},
                                   {"description", "components that share one execution context"},
                                   {"version", "1.0"},
                                   {"vendor", "jp.go.aist"},
                                   {"category", "composite.PeriodicECShared"},
                                   {"activity_type", "DataFlowComponent"},
                                   {"max_instance", "0"},
                                   {"language", "C++"},
                                   {"lang_type", "compile"},
                                   {"conf.default.members", ""},
                                   {"conf.default.exported_ports", ""}};
    coil::Properties properties;
    for (const auto& entry : spec) properties.setDefault(entry[0], entry[1]);
    return properties;
}

} // namespace

void register_shared_composite(Manager& manager) {
    coil::Properties profile = composite_profile();
    manager.registerFactory(profile, Create<PeriodicECSharedComposite>, Delete<PeriodicECSharedComposite>);
}

// The organization exists before onInitialize, so that tools can add members at any time.
PeriodicECSharedComposite::PeriodicECSharedComposite(Manager* manager)
    : RTObject_impl(manager),
      m_org(new SDOPackage::PeriodicECOrganization(this, RTObject_var(getObjRef()).in())) {
    m_ownedOrganizations->add(SDOPackage::Organization_var(m_org->getObjRef()).in());
    bindParameter("members", m_members, "", parse_names);
    for (const auto type :
         {ConfigurationSetListenerType::ON_SET_CONFIG_SET, ConfigurationSetListenerType::ON_ADD_CONFIG_SET})
        addConfigurationSetListener(type, new ExportedPortsListener(*m_org));
}

PeriodicECSharedComposite::~PeriodicECSharedComposite() {
    m_org->retire();
    m_org->_remove_ref();
}

// Applies the configuration here, before its members are needed. on_initialize() would apply it afterwards.
ReturnCode_t PeriodicECSharedComposite::onInitialize() {
    const std::string active = m_properties.getProperty("configuration.active_config", "default");
    m_configsets.update(m_configsets.haveConfig(active.c_str()) ? active.c_str() : "default");
    SDOPackage::SDOList members;
    for (const auto& name : m_members) {
        RTObject_impl* member = m_pManager->getComponent(coil::eraseBothEndsBlank(name).c_str());
        if (member == nullptr) {
            RTC_ERROR(("member %s: there is no such component; name it before the composite in "
                       "manager.components.precreate",
                       name.c_str()));
            continue;
        }
        SDOPackage::SDO_var sdo = SDOPackage::SDO::_duplicate(RTObject_var(member->getObjRef()).in());
        CORBA_SeqUtil::push_back(members, sdo);
    }
    const bool added = m_org->add_members(members);
    if (!m_members.empty()) warn_about_missing_ports(*this);
    return added ? RTC_OK : RTC_ERROR;
}

// A transition of the composite is a transition of all its members in the shared context.
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

// The init function of OpenRTM-aist's module of this name, for programs that call it.
void PeriodicECSharedCompositeInit(RTC::Manager* manager) { RTC::register_shared_composite(*manager); }
