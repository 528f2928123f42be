// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/settings.hpp"

#include "proxy/link/protocol/setting.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::interceptor {
namespace {

/// Returns a parameter that has no default. If it is missing, throws an exception that explains it.
std::string required(coil::Properties& properties, const std::string& name, const char* meaning) {
    std::string value = properties.getProperty(name);
    if (value.empty())
        throw std::runtime_error(
            fmt::format("parameter '{}' is missing: give {}, as in InterceptorComp?link=NAME&rtc=INSTANCE",
                        name, meaning));
    return value;
}

double number(coil::Properties& properties, const std::string& name, double default_value) {
    return link::parse_positive_number("parameter", name, properties.getProperty(name), default_value);
}

} // namespace

Settings read_settings(coil::Properties& properties) {
    Settings settings;
    settings.link = required(properties, "link", "the name that AdaptorComp's property 'link' has");
    settings.rtc = properties.getProperty("rtc");
    settings.manage = link::parse_flag("parameter", "manage", properties.getProperty("manage"));
    settings.call_timeout =
        std::chrono::milliseconds(static_cast<long>(number(properties, "call_timeout", 1000)));
    settings.ring_bytes = 1024 * static_cast<std::size_t>(number(properties, "ring_kib", 256));
    settings.large_bytes = 1024 * static_cast<std::size_t>(number(properties, "large_kib", 0));
    settings.segment_bytes =
        std::size_t{1024} * 1024 * static_cast<std::size_t>(number(properties, "segment_mib", 4));
    settings.group = properties.getProperty("group");
    settings.strict = link::parse_flag("parameter", "strict", properties.getProperty("strict"));
    return settings;
}

} // namespace tandem::interceptor
