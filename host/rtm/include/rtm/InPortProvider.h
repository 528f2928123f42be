// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_INPORTPROVIDER_H
#define RTC_INPORTPROVIDER_H
#include <coil/Factory.h>
#include <coil/Properties.h>
#include <rtm/BufferBase.h>
#include <rtm/DataPortStatus.h>
#include <rtm/InPortConnector.h>
#include <rtm/NVUtil.h>
#include <rtm/SystemLogger.h>
#include <string>

namespace RTC {

/// The receiving end of a transport for push connections, from a library: calls the ON_RECEIVED listeners for each
/// arriving message and writes it into the InPort's connector.
class InPortProvider {
  public:
    InPortProvider();
    virtual ~InPortProvider();
    virtual void init(coil::Properties& prop) = 0;
    virtual void setBuffer(BufferBase<ByteData>* buffer) = 0;
    virtual void setListener(ConnectorInfo& info, ConnectorListenersBase* listeners) = 0;
    virtual void setConnector(InPortConnector* connector) = 0;
    /// Publishes its types in the port's profile.
    virtual void publishInterfaceProfile(SDOPackage::NVList& prop);
    /// Publishes its address in the profile of a connection of its interface type. Returns false for other types.
    virtual bool publishInterface(SDOPackage::NVList& prop);

  protected:
    void setInterfaceType(const char* interface_type);
    void setDataFlowType(const char* dataflow_type);
    void setSubscriptionType(const char* subs_type);

    /// The address that publishInterface() publishes.
    SDOPackage::NVList m_properties;
    mutable Logger rtclog;

  private:
    std::string m_interfaceType, m_dataflowType, m_subscriptionType;
};
/// The registered providers, by the interface type that a connection requests.
using InPortProviderFactory = ::coil::GlobalFactory<InPortProvider>;

} // namespace RTC

extern template class coil::GlobalFactory<RTC::InPortProvider>;
#endif
