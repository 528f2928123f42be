// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/data/forwarding_out_port.hpp"

#include "host/log/log.hpp"

#include <rtm/NVUtil.h>

#include <exception>

namespace tandem::interceptor {

ForwardingOutPort::ForwardingOutPort(const char* name, const char* data_type, const std::string& channel_key)
    : ProxyPort(name, data_type) {
    addProperty("dataport.marshaling_types", "cdr");
    coil::Properties properties;
    properties.setProperty("channel", channel_key);
    properties.setProperty("read.empty_policy", "do_nothing"); // each message is sent once
    buffer_.init(properties);
}

RTC::ReturnCode_t ForwardingOutPort::publishInterfaces(RTC::ConnectorProfile& profile) {
    if (coil::normalize(NVUtil::toString(profile.properties, "dataport.serializer.cdr.endian"))
            .starts_with("big"))
        return refuse_connection(RTC::BAD_PARAMETER,
                                 std::string(getName()) + ": this port sends little-endian data only");
    return RTC::OutPortBase::publishInterfaces(profile);
}

bool ForwardingOutPort::is_connected() {
    const std::lock_guard lock(m_connectorsMutex);
    return !m_connectors.empty();
}

void ForwardingOutPort::forward() {
    for (;;) {
        const auto status = buffer_.read(message_, {});
        if (status == RTC::BufferStatus::OK)
            send();
        else if (status != RTC::BufferStatus::BUFFER_ERROR) // a message that could not be decoded is gone
            return;
    }
}

void ForwardingOutPort::send() {
    std::vector<std::string> lost;
    {
        const std::lock_guard lock(m_connectorsMutex);
        for (auto* connector : m_connectors) {
            const RTC::DataPortStatus status = write_to(*connector);
            if (status == RTC::DataPortStatus::CONNECTION_LOST) lost.emplace_back(connector->id());
            if (status != RTC::DataPortStatus::PORT_OK) report_not_taken(status);
        }
    }
    // Called without the mutex, because disconnecting locks it.
    if (!lost.empty()) end_lost_connections(lost);
}

void ForwardingOutPort::report_not_taken(RTC::DataPortStatus status) {
    buffer_.count_discarded();
    if (status != RTC::DataPortStatus::PORT_ERROR &&
        not_taken_.should_log()) // the log already names a listener that threw
        log::warn("port '{}': the RTC's port did not take a message ({}), {} lost so far", getName(),
                  RTC::toString(status), not_taken_.count());
}

/// Listeners of the RTC's InPort run in it and may throw anything, which must not end the host. In OpenRTM-aist, CORBA returns
/// the exception to the sender without details.
RTC::DataPortStatus ForwardingOutPort::write_to(RTC::OutPortConnector& connector) {
    std::string thrown;
    try {
        return engine::write_bytes(connector, message_);
    } catch (const CORBA::Exception& error) {
        thrown = std::string("CORBA exception ") + error._name();
    } catch (const std::exception& error) {
        thrown = error.what();
    } catch (...) {
        thrown = "something other than a std::exception";
    }
    if (thrown_.should_log())
        log::error("port '{}': a listener of the RTC's InPort threw {} when a message came ({} so far)",
                   getName(), thrown, thrown_.count());
    return RTC::DataPortStatus::PORT_ERROR;
}

} // namespace tandem::interceptor
