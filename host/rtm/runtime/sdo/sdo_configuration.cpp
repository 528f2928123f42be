// SPDX-License-Identifier: Apache-2.0
// The interface Configuration of the OMG SDO specification, and the SDO part of RTC::RTObject. OpenRTM-aist:
// class Configuration_impl of SdoConfiguration.h, RTObject_impl. Errors are the specification's exceptions.
#include "host/rtm/runtime/sdo/sdo_configuration.hpp"
#include "host/rtm/runtime/configuration/parameter_values.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include <rtm/Manager.h>

namespace SDOPackage {
namespace {

// A set as tools see it: its name, its description, and its parameters as strings.
ConfigurationSet to_corba(const coil::Properties& set) {
    ConfigurationSet out;
    out.id = CORBA::string_dup(set.getName());
    out.description = CORBA::string_dup(set.getProperty("description").c_str());
    NVUtil::copyFromProperties(out.configuration_data, set);
    return out;
}

coil::Properties to_properties(const ConfigurationSet& set) {
    coil::Properties out(set.id);
    NVUtil::copyToProperties(out, set.configuration_data);
    return out;
}

// OpenRTM-aist accepts any text, and the variable then keeps its default without a word.
void require_accepted(bool accepted) {
    if (accepted) return;
    const std::string& refused = RTC::last_refused_value();
    throw InvalidParameter(refused.empty() ? "the id of a configuration set must not be empty or have a dot"
                                           : refused.c_str());
}

// __widget__, __constraints__ ...: sets that tell tools how to present parameters.
bool is_description(const coil::Properties& set) {
    return std::string(set.getName()).compare(0, 2, "__") == 0;
}

} // namespace

Configuration_impl::Configuration_impl(RTC::RTObject_impl& owner, RTC::ConfigAdmin& sets,
                                       std::shared_ptr<Organizations> organizations)
    : sets_(sets), services_(owner, RTC::Manager::instance().getConfig()),
      organizations_(std::move(organizations)), poa_(RTC::Manager::instance().getPOA()) {
    RTC::set_servant_owner(this, RTC::find_servant_owner(&owner));
    id_ = poa_->activate_object(this);
}

// Ends the services, then refuses the calls of tools.
void Configuration_impl::retire() {
    services_.finalize();
    RTC::set_servant_owner(this, nullptr);
    try {
        poa_->deactivate_object(id_.in());
    } catch (const CORBA::Exception&) {
        // the ORB has been shut down before: nothing is active any more
    }
}

// Device profiles are not supported; the result false reports this to the tool.
CORBA::Boolean Configuration_impl::set_device_profile(const DeviceProfile&) { return false; }
// A tool offers a service, and the component gets a consumer for it.
CORBA::Boolean Configuration_impl::add_service_profile(const ServiceProfile& profile) {
    return services_.add_consumer(profile);
}
CORBA::Boolean Configuration_impl::add_organization(Organization_ptr organization) {
    return organizations_->add(organization);
}
CORBA::Boolean Configuration_impl::remove_service_profile(const char* id) {
    return services_.remove_consumer(id);
}
CORBA::Boolean Configuration_impl::remove_organization(const char* id) { return organizations_->remove(id); }
ParameterList* Configuration_impl::get_configuration_parameters() { return new ParameterList; }

NVList* Configuration_impl::get_configuration_parameter_values() {
    NVList_var values = new NVList;
    NVUtil::copyFromProperties(values.inout(), sets_.getActiveConfigurationSet());
    return values._retn();
}

// Values are strings, whatever the type of the variable, because configuration sets hold strings.
CORBA::Any* Configuration_impl::get_configuration_parameter_value(const char* name) {
    const coil::Properties set = sets_.getActiveConfigurationSet();
    if (set.findNode(name) == nullptr)
        throw InvalidParameter("the active configuration set has no such parameter");
    CORBA::Any_var value = new CORBA::Any;
    value.inout() <<= set.getProperty(name).c_str();
    return value._retn();
}

// Changes one value of the active set; the variable follows between two cycles (ConfigAdmin::update()).
CORBA::Boolean Configuration_impl::set_configuration_parameter(const char* name, const CORBA::Any& value) {
    const char* text = nullptr;
    if (!(value >>= text)) throw InvalidParameter("the value of a parameter must be a string");
    coil::Properties change(sets_.activeId().c_str());
    change.setProperty(name, text);
    require_accepted(sets_.setConfigurationSetValues(change));
    return true;
}

ConfigurationSetList* Configuration_impl::get_configuration_sets() {
    ConfigurationSetList_var list = new ConfigurationSetList;
    for (const auto& set : sets_.copies())
        if (!is_description(set)) CORBA_SeqUtil::push_back(list.inout(), to_corba(set));
    return list._retn();
}

// Also returns description sets, which tools read by name.
ConfigurationSet* Configuration_impl::get_configuration_set(const char* config_id) {
    if (!sets_.haveConfig(config_id)) throw InternalError("no such configuration set");
    return new ConfigurationSet(to_corba(sets_.getConfigurationSet(config_id)));
}

CORBA::Boolean Configuration_impl::set_configuration_set_values(const ConfigurationSet& set) {
    require_accepted(sets_.setConfigurationSetValues(to_properties(set)));
    return true;
}

ConfigurationSet* Configuration_impl::get_active_configuration_set() {
    return new ConfigurationSet(to_corba(sets_.getActiveConfigurationSet()));
}

CORBA::Boolean Configuration_impl::add_configuration_set(const ConfigurationSet& set) {
    return sets_.addConfigurationSet(to_properties(set));
}
CORBA::Boolean Configuration_impl::remove_configuration_set(const char* config_id) {
    return sets_.removeConfigurationSet(config_id);
}
CORBA::Boolean Configuration_impl::activate_configuration_set(const char* config_id) {
    if (!sets_.activateConfigurationSet(config_id)) throw InvalidParameter("no such configuration set");
    return true;
}

} // namespace SDOPackage

namespace RTC {

SDOPackage::OrganizationList* RTObject_impl::get_owned_organizations() {
    return m_ownedOrganizations->list();
}
// The id within organizations; the caller frees the string.
char* RTObject_impl::get_sdo_id() { return CORBA::string_dup(m_profile.instance_name); }
char* RTObject_impl::get_sdo_type() { return CORBA::string_dup(m_profile.description); }
SDOPackage::DeviceProfile* RTObject_impl::get_device_profile() { return new SDOPackage::DeviceProfile; }
SDOPackage::ServiceProfileList* RTObject_impl::get_service_profiles() {
    SDOPackage::Configuration_var created = get_configuration();
    return m_sdoConfiguration->services().profiles();
}
SDOPackage::ServiceProfile* RTObject_impl::get_service_profile(const char* id) {
    SDOPackage::Configuration_var created = get_configuration();
    return new SDOPackage::ServiceProfile(m_sdoConfiguration->services().profile(id));
}
SDOPackage::SDOService_ptr RTObject_impl::get_sdo_service(const char* id) {
    SDOPackage::Configuration_var created = get_configuration();
    return SDOPackage::SDOService::_duplicate(m_sdoConfiguration->services().profile(id).service);
}
bool RTObject_impl::addSdoServiceProvider(const SDOPackage::ServiceProfile& profile,
                                          SdoServiceProviderBase* provider) {
    SDOPackage::Configuration_var created = get_configuration();
    return m_sdoConfiguration->services().add_provider(profile, provider);
}
bool RTObject_impl::removeSdoServiceProvider(const char* id) {
    SDOPackage::Configuration_var created = get_configuration();
    return m_sdoConfiguration->services().remove_provider(id);
}
bool RTObject_impl::addSdoServiceConsumer(const SDOPackage::ServiceProfile& profile) {
    SDOPackage::Configuration_var created = get_configuration();
    return m_sdoConfiguration->services().add_consumer(profile);
}
bool RTObject_impl::removeSdoServiceConsumer(const char* id) {
    SDOPackage::Configuration_var created = get_configuration();
    return m_sdoConfiguration->services().remove_consumer(id);
}
// Created at the first request, because most components are never asked. The functions above call this to make sure
// that m_sdoConfiguration exists.
SDOPackage::Configuration_ptr RTObject_impl::get_configuration() {
    std::lock_guard<std::mutex> lock(m_contextsMutex);
    if (m_sdoConfiguration == nullptr)
        m_sdoConfiguration = new SDOPackage::Configuration_impl(*this, m_configsets, m_organizations);
    return m_sdoConfiguration->_this();
}
// Optional in the specification; OpenRTM-aist does not implement it either.
SDOPackage::Monitoring_ptr RTObject_impl::get_monitoring() {
    throw SDOPackage::InterfaceNotImplemented("this component has no Monitoring interface");
}
SDOPackage::OrganizationList* RTObject_impl::get_organizations() { return m_organizations->list(); }
SDOPackage::NVList* RTObject_impl::get_status_list() { return new SDOPackage::NVList; }
CORBA::Any* RTObject_impl::get_status(const char*) {
    throw SDOPackage::InvalidParameter("this component has no status");
}

} // namespace RTC
