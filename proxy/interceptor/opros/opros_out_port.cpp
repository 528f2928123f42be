// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/opros/opros_out_port.hpp"

#include <rtm/NVUtil.h>

namespace tandem::interceptor {

OprosOutPort::OprosOutPort(const char* name, const char* data_type, const std::string& channel_key)
    : RTC::OutPortBase(name, data_type) {
    addProperty("dataport.marshaling_types", "cdr");
    coil::Properties properties;
    properties.setProperty("channel", channel_key);
    buffer_.init(properties);
}

RTC::ReturnCode_t OprosOutPort::publishInterfaces(RTC::ConnectorProfile& profile) {
    if (coil::normalize(NVUtil::toString(profile.properties, "dataport.serializer.cdr.endian"))
            .starts_with("big"))
        return refuse(RTC::BAD_PARAMETER,
                      std::string(getName()) +
                          ": this port of an OPRoS component sends little-endian data only");
    return RTC::OutPortBase::publishInterfaces(profile);
}

bool OprosOutPort::is_connected() {
    const std::lock_guard lock(m_connectorsMutex);
    return !m_connectors.empty();
}

void OprosOutPort::forward() {
    while (buffer_.read(message_, {}) == RTC::BufferStatus::OK) send();
}

void OprosOutPort::send() {
    std::vector<std::string> lost;
    {
        const std::lock_guard lock(m_connectorsMutex);
        for (auto* connector : m_connectors)
            if (connector->write(message_) == RTC::DataPortStatus::CONNECTION_LOST)
                lost.emplace_back(connector->id());
    }
    // Without the mutex, which disconnecting locks.
    if (!lost.empty()) dropLostConnections(lost);
}

} // namespace tandem::interceptor
