// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INPORTCONSUMER_H
#define RTC_INPORTCONSUMER_H
#include <coil/Factory.h>
#include <coil/Properties.h>
#include <rtm/ByteData.h>
#include <rtm/DataPortStatus.h>
#include <rtm/idl/SDOPackageSkel.h>

namespace RTC {

/// The sending end of a transport for push connections, from a library: sends messages to the InPort's provider. Used
/// by one thread at a time.
class InPortConsumer {
  public:
    virtual ~InPortConsumer() = default;
    virtual void init(coil::Properties& prop) = 0;
    /// Sends one message. If it returns CONNECTION_LOST, the connection ends.
    virtual DataPortStatus put(ByteData& data) = 0;
    virtual void publishInterfaceProfile(SDOPackage::NVList& properties) = 0;
    /// Finds the provider's address in the connection's profile. Returns false if it is missing.
    virtual bool subscribeInterface(const SDOPackage::NVList& properties) = 0;
    virtual void unsubscribeInterface(const SDOPackage::NVList& properties) = 0;
};
/// The registered consumers, by the interface type that a connection requests.
using InPortConsumerFactory = ::coil::GlobalFactory<InPortConsumer>;

} // namespace RTC

extern template class coil::GlobalFactory<RTC::InPortConsumer>;
#endif
