// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_OUTPORTPROVIDER_H
#define RTC_OUTPORTPROVIDER_H
#include <coil/Factory.h>
#include <coil/Properties.h>
#include <rtm/BufferBase.h>
#include <rtm/DataPortStatus.h>
#include <rtm/NVUtil.h>
#include <rtm/OutPortConnector.h>
#include <rtm/SystemLogger.h>
#include <string>

namespace RTC {

/// The sending end of a transport for pull connections, from a library: calls the ON_SEND listeners for each waiting
/// message of the OutPort's connector and passes it to its consumer.
class OutPortProvider {
  public:
    OutPortProvider();
    virtual ~OutPortProvider();
    virtual void init(coil::Properties& prop);
    virtual void setBuffer(CdrBufferBase* buffer) = 0;
    virtual void setListener(ConnectorInfo& info, ConnectorListenersBase* listeners) = 0;
    virtual void setConnector(OutPortConnector* connector) = 0;
    /// Publishes its types in the port's profile.
    virtual void publishInterfaceProfile(SDOPackage::NVList& prop);
    /// Publishes its address in the profile of a connection of its interface type. Returns false for other types.
    virtual bool publishInterface(SDOPackage::NVList& prop);

  protected:
    void setPortType(const char* port_type);
    void setDataType(const char* data_type);
    void setInterfaceType(const char* interface_type);
    void setDataFlowType(const char* dataflow_type);
    void setSubscriptionType(const char* subs_type);

    /// The address that publishInterface() publishes.
    SDOPackage::NVList m_properties;
    mutable Logger rtclog;

  private:
    std::string m_portType, m_dataType;
    std::string m_interfaceType, m_dataflowType, m_subscriptionType;
};
/// The registered providers, by the interface type that a connection requests.
using OutPortProviderFactory = ::coil::GlobalFactory<OutPortProvider>;

} // namespace RTC

extern template class coil::GlobalFactory<RTC::OutPortProvider>;
#endif
