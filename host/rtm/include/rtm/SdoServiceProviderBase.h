// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_SDOSERVICEPROVIDERBASE_H
#define RTC_SDOSERVICEPROVIDERBASE_H
#include <coil/Factory.h>
#include <coil/Timer.h>
#include <rtm/RTObject.h>
#include <rtm/idl/SDOPackageStub.h>

namespace RTC {

/// A service of a component for tools (SDO get_sdo_service).
class SdoServiceProviderBase : public virtual POA_SDOPackage::SDOService,
                               public virtual PortableServer::RefCountServantBase {
  public:
    ~SdoServiceProviderBase() override = default;
    virtual bool init(RTObject_impl& rtobj, const SDOPackage::ServiceProfile& profile) = 0;
    virtual bool reinit(const SDOPackage::ServiceProfile& profile) = 0;
    virtual const SDOPackage::ServiceProfile& getProfile() const = 0;
    virtual void finalize() = 0;
};
/// The registered providers, by the repository id of the service.
using SdoServiceProviderFactory = ::coil::GlobalFactory<SdoServiceProviderBase>;

} // namespace RTC

extern template class coil::GlobalFactory<RTC::SdoServiceProviderBase>;
#endif
