// SPDX-License-Identifier: Apache-2.0
// InPortProvider and OutPortProvider, base classes for the transports of component libraries, and the
// factories of such transports, instantiated here so that all libraries of a process share one instance.
#include <rtm/InPortConsumer.h>
#include <rtm/InPortProvider.h>
#include <rtm/OutPortConsumer.h>
#include <rtm/OutPortProvider.h>

template class coil::GlobalFactory<RTC::InPortConsumer>;
template class coil::GlobalFactory<RTC::InPortProvider>;
template class coil::GlobalFactory<RTC::OutPortConsumer>;
template class coil::GlobalFactory<RTC::OutPortProvider>;

namespace RTC {
namespace {

void publish_types(SDOPackage::NVList& prop, const std::string& interface_type,
                   const std::string& dataflow_type, const std::string& subscription_type) {
    NVUtil::appendStringValue(prop, "dataport.interface_type", interface_type.c_str());
    NVUtil::appendStringValue(prop, "dataport.dataflow_type", dataflow_type.c_str());
    NVUtil::appendStringValue(prop, "dataport.subscription_type", subscription_type.c_str());
}

} // namespace

InPortProvider::InPortProvider() : rtclog("InPortProvider") {}
InPortProvider::~InPortProvider() = default;
void InPortProvider::setInterfaceType(const char* interface_type) { m_interfaceType = interface_type; }
void InPortProvider::setDataFlowType(const char* dataflow_type) { m_dataflowType = dataflow_type; }
void InPortProvider::setSubscriptionType(const char* subs_type) { m_subscriptionType = subs_type; }
void InPortProvider::publishInterfaceProfile(SDOPackage::NVList& prop) {
    publish_types(prop, m_interfaceType, m_dataflowType, m_subscriptionType);
}
// Several providers are asked in turn; only the one of the connection's interface type publishes its address.
bool InPortProvider::publishInterface(SDOPackage::NVList& prop) {
    if (!NVUtil::isStringValue(prop, "dataport.interface_type", m_interfaceType.c_str())) return false;
    NVUtil::append(prop, m_properties);
    return true;
}

OutPortProvider::OutPortProvider() : rtclog("OutPortProvider") {}
OutPortProvider::~OutPortProvider() = default;
void OutPortProvider::init(coil::Properties&) {}
void OutPortProvider::setPortType(const char* port_type) { m_portType = port_type; }
void OutPortProvider::setDataType(const char* data_type) { m_dataType = data_type; }
void OutPortProvider::setInterfaceType(const char* interface_type) { m_interfaceType = interface_type; }
void OutPortProvider::setDataFlowType(const char* dataflow_type) { m_dataflowType = dataflow_type; }
void OutPortProvider::setSubscriptionType(const char* subs_type) { m_subscriptionType = subs_type; }
void OutPortProvider::publishInterfaceProfile(SDOPackage::NVList& prop) {
    NVUtil::appendStringValue(prop, "dataport.data_type", m_dataType.c_str());
    publish_types(prop, m_interfaceType, m_dataflowType, m_subscriptionType);
}
bool OutPortProvider::publishInterface(SDOPackage::NVList& prop) {
    if (!NVUtil::isStringValue(prop, "dataport.interface_type", m_interfaceType.c_str())) return false;
    NVUtil::append(prop, m_properties);
    return true;
}

} // namespace RTC
