// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <mutex>
#include <rtm/SdoServiceConsumerBase.h>
#include <rtm/SdoServiceProviderBase.h>
#include <string>
#include <vector>

namespace RTC {

/// The SDO services of one component: providers, which tools call, and consumers, which call a tool's service.
/// Modules bring their types along through SdoServiceProviderFactory and SdoServiceConsumerFactory. Owned by
/// the component's Configuration_impl. [any-thread]
class SdoServices {
  public:
    SdoServices(RTObject_impl& owner, const coil::Properties& config);
    ~SdoServices();
    SdoServices(const SdoServices&) = delete;
    SdoServices& operator=(const SdoServices&) = delete;

    /// Creates a provider of each registered type that `sdo.service.provider.enabled_services` names
    /// (default: ALL).
    void start_providers();
    /// Finalizes all services; none calls the component afterwards.
    void finalize();

    /// Takes over the provider. Returns false if its id is in use or its init() fails.
    bool add_provider(const SDOPackage::ServiceProfile& profile, SdoServiceProviderBase* provider);
    bool remove_provider(const std::string& id);
    /// Creates a consumer for the profile's interface type; an existing consumer with this id gets the new profile. Returns false
    /// if the type is neither registered nor one of make_tool_service(), if it is not in
    /// `sdo.service.consumer.enabled_services`, if there are 32 consumers, or if init() fails.
    bool add_consumer(const SDOPackage::ServiceProfile& profile);
    bool remove_consumer(const std::string& id);

    /// Returns the profiles of all providers. The caller owns the list.
    SDOPackage::ServiceProfileList* profiles() const;
    /// Returns the profile of a provider. Throws SDOPackage::InvalidParameter if none has that id.
    SDOPackage::ServiceProfile profile(const std::string& id) const;

  private:
    bool is_enabled(const char* kind, const std::string& type) const;
    /// Releases the services of tools that have ended, and that of this id, which is about to be replaced.
    void release_tools(const std::string& id);

    RTObject_impl& owner_;
    coil::Properties config_;
    mutable std::recursive_mutex mutex_;
    std::vector<SdoServiceProviderBase*> providers_;
    std::vector<SdoServiceConsumerBase*> consumers_;
};

} // namespace RTC
