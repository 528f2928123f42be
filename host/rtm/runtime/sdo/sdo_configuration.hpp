// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/sdo/organization.hpp"
#include "host/rtm/runtime/sdo/sdo_services.hpp"
#include <rtm/RTObject.h>

namespace SDOPackage {

/// The remote interface to the configuration sets and SDO services of one component. Created at the first
/// request for it; owned by the component through its reference count. [any-thread]
class Configuration_impl : public POA_SDOPackage::Configuration {
  public:
    Configuration_impl(RTC::RTObject_impl& owner, RTC::ConfigAdmin& sets,
                       std::shared_ptr<Organizations> organizations);
    RTC::SdoServices& services() { return services_; }
    /// Ends the services and deactivates the servant; called when the component exits.
    void retire();

    CORBA::Boolean set_device_profile(const DeviceProfile& profile) override;
    CORBA::Boolean add_service_profile(const ServiceProfile& profile) override;
    CORBA::Boolean add_organization(Organization_ptr organization) override;
    CORBA::Boolean remove_service_profile(const char* id) override;
    CORBA::Boolean remove_organization(const char* organization_id) override;
    ParameterList* get_configuration_parameters() override;
    NVList* get_configuration_parameter_values() override;
    CORBA::Any* get_configuration_parameter_value(const char* name) override;
    CORBA::Boolean set_configuration_parameter(const char* name, const CORBA::Any& value) override;
    ConfigurationSetList* get_configuration_sets() override;
    ConfigurationSet* get_configuration_set(const char* config_id) override;
    CORBA::Boolean set_configuration_set_values(const ConfigurationSet& set) override;
    ConfigurationSet* get_active_configuration_set() override;
    CORBA::Boolean add_configuration_set(const ConfigurationSet& set) override;
    CORBA::Boolean remove_configuration_set(const char* config_id) override;
    CORBA::Boolean activate_configuration_set(const char* config_id) override;

  private:
    RTC::ConfigAdmin& sets_;
    RTC::SdoServices services_;
    std::shared_ptr<Organizations> organizations_; // of which the component is a member
    PortableServer::POA_var poa_;
    PortableServer::ObjectId_var id_;
};

} // namespace SDOPackage
