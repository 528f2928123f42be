// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/settings.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace tandem::adaptor {
namespace {

double number(const std::map<std::string, std::string>& properties, const std::string& name,
              double otherwise) {
    const auto at = properties.find(name);
    if (at == properties.end() || at->second.empty()) return otherwise;
    const std::string& text = at->second;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value < 1e6))
        throw std::runtime_error(
            fmt::format("property '{}' is '{}', a number above 0 was expected", name, text));
    return value;
}

} // namespace

Settings read_settings(const std::map<std::string, std::string>& properties) {
    Settings settings;
    const auto link = properties.find("link");
    if (link == properties.end() || link->second.empty())
        throw std::runtime_error(
            "property 'link' is missing: give it the name that InterceptorComp's 'link' has");
    settings.link = link->second;
    const auto milliseconds = [](double value) {
        return std::chrono::milliseconds(static_cast<long>(value));
    };
    settings.wait = milliseconds(1000 * number(properties, "wait", 10));
    settings.call_timeout = milliseconds(number(properties, "call_timeout", 1000));
    settings.segment_bytes = 1024 * 1024 * static_cast<std::size_t>(number(properties, "segment_mib", 4));
    return settings;
}

} // namespace tandem::adaptor
