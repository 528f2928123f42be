// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OUTPORTCONSUMER_H
#define RTC_OUTPORTCONSUMER_H
#include <coil/Factory.h>
#include <coil/Properties.h>
#include <rtm/CdrBufferBase.h>
#include <rtm/ConnectorListener.h>
#include <rtm/DataPortStatus.h>
#include <rtm/SystemLogger.h>
#include <rtm/idl/SDOPackageSkel.h>

namespace RTC {

/// The receiving end of a transport for pull connections, from a library: fetches messages from the OutPort's
/// provider. Used by one thread at a time.
class OutPortConsumer {
  public:
    virtual ~OutPortConsumer() = default;
    virtual void init(coil::Properties& prop) = 0;
    virtual void setBuffer(CdrBufferBase* buffer) = 0;
    virtual void setListener(ConnectorInfo& info, ConnectorListenersBase* listeners) = 0;
    virtual DataPortStatus get(ByteData& data) = 0;
    /// Finds the provider's address in the connection's profile. Returns false if it is missing.
    virtual bool subscribeInterface(const SDOPackage::NVList& properties) = 0;
    virtual void unsubscribeInterface(const SDOPackage::NVList& properties) = 0;
};
/// The registered consumers, by the interface type that a connection requests.
using OutPortConsumerFactory = ::coil::GlobalFactory<OutPortConsumer>;

} // namespace RTC

extern template class coil::GlobalFactory<RTC::OutPortConsumer>;
#endif
