// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/opros/opros_in_port.hpp"

#include "proxy/interceptor/data/link_buffer.hpp"

#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>

namespace tandem::interceptor {
namespace {

std::string first_of_list(const RTC::ConnectorProfile& profile, const char* key) {
    const std::string list = coil::normalize(NVUtil::toString(profile.properties, key));
    return list.substr(0, list.find(','));
}

} // namespace

OprosInPort::OprosInPort(const char* name, const char* data_type, std::string channel_key)
    : ProxyPort(name, data_type), channel_key_(std::move(channel_key)) {
    addProperty("dataport.marshaling_types", "cdr");
    m_singlebuffer = false; // each connection has the LinkBuffer that publishInterfaces() names
}

/// The sender's thread passes arriving messages on to the link.
void OprosInPort::init(coil::Properties& properties) {
    RTC::InPortBase::init(properties);
    const std::lock_guard lock(m_profile_mutex);
    auto& of_profile = m_profile.properties;
    if (const auto at = NVUtil::find_index(of_profile, "dataport.dataflow_type"); at >= 0)
        of_profile[static_cast<CORBA::ULong>(at)] = NVUtil::newNV("dataport.dataflow_type", "push");
}

RTC::ReturnCode_t OprosInPort::publishInterfaces(RTC::ConnectorProfile& profile) {
    if (first_of_list(profile, "dataport.dataflow_type") == "pull")
        return refuse_connection(RTC::BAD_PARAMETER,
                                 std::string(getName()) +
                                     ": this port of an OPRoS component takes pushed data only");
    if (first_of_list(profile, "dataport.serializer.cdr.endian") == "big")
        return refuse_connection(RTC::BAD_PARAMETER,
                                 std::string(getName()) +
                                     ": this port of an OPRoS component takes little-endian data only");
    const std::pair<const char*, const char*> properties[] = {
        {"dataport.inport.buffer_type", LinkBuffer::factory_name},
        {"dataport.inport.buffer.channel", channel_key_.c_str()}};
    for (const auto& [name, value] : properties)
        CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV(name, value));
    return RTC::InPortBase::publishInterfaces(profile);
}

} // namespace tandem::interceptor
