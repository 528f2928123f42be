// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_SDOSERVICECONSUMERBASE_H
#define RTC_SDOSERVICECONSUMERBASE_H
#include <coil/Factory.h>
#include <coil/Timer.h>
#include <rtm/RTObject.h>
#include <rtm/idl/SDOPackageStub.h>

namespace RTC {

/// Uses a service that a tool adds to a component (SDO add_service_profile).
class SdoServiceConsumerBase {
  public:
    virtual ~SdoServiceConsumerBase() = default;
    virtual bool init(RTObject_impl& rtobj, const SDOPackage::ServiceProfile& profile) = 0;
    virtual bool reinit(const SDOPackage::ServiceProfile& profile) = 0;
    virtual const SDOPackage::ServiceProfile& getProfile() const = 0;
    virtual void finalize() = 0;
};
/// The registered consumers, by the repository id of the service.
using SdoServiceConsumerFactory = ::coil::GlobalFactory<SdoServiceConsumerBase>;

} // namespace RTC

extern template class coil::GlobalFactory<RTC::SdoServiceConsumerBase>;
#endif
