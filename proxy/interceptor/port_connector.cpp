// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/port_connector.hpp"

#include "host/log/log.hpp"
#include "host/process/published/notices.hpp"
#include "proxy/interceptor/engine/proxy_port.hpp"

#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::interceptor {

std::string PortConnector::connect(RTC::PortBase& mirror, const RtcPort& port, const std::string& name,
                                   const Properties& properties) {
    RTC::ConnectorProfile profile;
    profile.name = name.c_str();
    profile.connector_id = "";
    CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(mirror.getPortRef()));
    CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(port.reference));
    for (const auto& [key, value] : properties)
        CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV(key, value.c_str()));
    if (mirror.connect(profile) == RTC::RTC_OK) return "";
    std::string reason = fmt::format("port '{}' cannot be connected with that of {}: {}", mirror.getName(),
                                     port.entry.component, engine::connect_error(mirror));
    leave_out(reason);
    return reason;
}

void PortConnector::leave_out(const std::string& reason) {
    if (strict_) throw std::runtime_error(reason);
    const std::string line =
        fmt::format("{}: {}; this port is left out, and the others work", owner_.getInstanceName(), reason);
    log::error("{}", line);
    process::publish_notice(process::NoticeKind::setting, line);
}

} // namespace tandem::interceptor
