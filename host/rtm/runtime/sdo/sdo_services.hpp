// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <mutex>
#include <rtm/SdoServiceConsumerBase.h>
#include <rtm/SdoServiceProviderBase.h>
#include <string>
#include <vector>

namespace RTC {

/// The SDO services of one component: those it offers to tools, and those of tools that it uses. What makes
/// them comes from the factories SdoServiceProviderFactory and SdoServiceConsumerFactory. [any-thread]
class SdoServices {
  public:
    SdoServices(RTObject_impl& owner, const coil::Properties& config);
    ~SdoServices();
    SdoServices(const SdoServices&) = delete;
    SdoServices& operator=(const SdoServices&) = delete;

    /// Makes every provider that `sdo.service.provider.enabled_services` names (ALL).
    void start_providers();
    /// Ends them all; nothing calls the component any more.
    void finalize();

    /// False: there is one of that id.
    bool add_provider(const SDOPackage::ServiceProfile& profile, SdoServiceProviderBase* provider);
    bool remove_provider(const std::string& id);
    /// A consumer of that id gets the new profile. False: no library brings one for its interface type, or
    /// `sdo.service.consumer.enabled_services` does not name it.
    bool add_consumer(const SDOPackage::ServiceProfile& profile);
    bool remove_consumer(const std::string& id);

    SDOPackage::ServiceProfileList* profiles() const;
    /// Throws SDOPackage::InvalidParameter when there is none of that id.
    SDOPackage::ServiceProfile profile(const std::string& id) const;

  private:
    bool enabled(const char* kind, const std::string& type) const;

    RTObject_impl& owner_;
    coil::Properties config_;
    mutable std::recursive_mutex mutex_;
    std::vector<SdoServiceProviderBase*> providers_;
    std::vector<SdoServiceConsumerBase*> consumers_;
};

} // namespace RTC
