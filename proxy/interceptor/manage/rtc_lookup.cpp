// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/manage/rtc_lookup.hpp"

#include "proxy/interceptor/manage/built_in_service.hpp"

#include <fmt/format.h>

namespace tandem::interceptor {

RTC::RTObject_var find_rtc(RTC::Manager& manager, const std::string& name) {
    RTC::RTCList found = manager.getNaming()->string_to_component(name);
    if (found.length() == 0)
        throw OperationFailed(
            fmt::format("there is no RTC '{}'; give Name0, rtcname://HOST:PORT/CONTEXT/Name0.rtc or "
                        "rtcloc://HOST:PORT/Name0 of one that runs",
                        name));
    return RTC::RTObject::_duplicate(found[0]);
}

RTC::PortService_var find_port(const std::string& name) {
    RTC::PortService_var port = CORBA_RTCUtil::get_port_by_url(name);
    if (CORBA::is_nil(port.in()))
        throw OperationFailed(
            fmt::format("there is no port '{}'; give Name0.port of an RTC that runs, or its "
                        "rtcname:// or rtcloc:// address followed by .port",
                        name));
    return port;
}

void require_ok(RTC::ReturnCode_t code, const std::string& what) {
    const auto name = [&] {
        switch (code) {
        case RTC::BAD_PARAMETER:
            return "BAD_PARAMETER";
        case RTC::UNSUPPORTED:
            return "UNSUPPORTED";
        case RTC::OUT_OF_RESOURCES:
            return "OUT_OF_RESOURCES";
        case RTC::PRECONDITION_NOT_MET:
            return "PRECONDITION_NOT_MET";
        default:
            return "RTC_ERROR";
        }
    };
    if (code != RTC::RTC_OK) throw OperationFailed(fmt::format("{}: the answer is {}", what, name()));
}

} // namespace tandem::interceptor
