// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/settings.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace tandem::interceptor {
namespace {

std::string required(coil::Properties& properties, const std::string& name, const char* what) {
    std::string value = properties.getProperty(name);
    if (value.empty())
        throw std::runtime_error(fmt::format(
            "parameter '{}' is missing: give {}, as in InterceptorComp?link=NAME&rtc=INSTANCE", name, what));
    return value;
}

double number(coil::Properties& properties, const std::string& name, double otherwise) {
    const std::string text = properties.getProperty(name);
    if (text.empty()) return otherwise;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value < 1e6))
        throw std::runtime_error(
            fmt::format("parameter '{}' is '{}', a number above 0 was expected", name, text));
    return value;
}

} // namespace

Settings read_settings(coil::Properties& properties) {
    Settings settings;
    settings.link = required(properties, "link", "the name that AdaptorComp's property 'link' has");
    settings.rtc =
        required(properties, "rtc", "the instance name of the RTC to share, created before this one");
    settings.call_timeout =
        std::chrono::milliseconds(static_cast<long>(number(properties, "call_timeout", 1000)));
    settings.ring_bytes = 1024 * static_cast<std::size_t>(number(properties, "ring_kib", 256));
    settings.segment_bytes = 1024 * 1024 * static_cast<std::size_t>(number(properties, "segment_mib", 4));
    return settings;
}

} // namespace tandem::interceptor
