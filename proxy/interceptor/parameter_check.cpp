// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/parameter_check.hpp"

#include "proxy/link/protocol/port_settings.hpp"

#include <fmt/format.h>

namespace tandem::interceptor {
namespace {

constexpr link::PortSetting port_parameters[] = {link::keep_last_setting, link::wait_ms_setting,
                                                 link::deadline_ms_setting};
constexpr link::PortSettings settings{"parameter", "AdaptorComp", true, port_parameters};

bool is_unknown(const std::string& parameter, const link::PortTable& own) {
    const auto dot = parameter.find('.');
    return dot != std::string::npos && !settings.find(parameter) && own.find(parameter.substr(dot + 1));
}

} // namespace

std::vector<std::string> find_useless_parameters(const std::vector<std::string>& parameters,
                                                 const link::PortTable& own) {
    auto lines = link::find_settings_without_port(parameters, own, settings);
    for (const auto& parameter : parameters)
        if (is_unknown(parameter, own))
            lines.push_back(fmt::format("parameter '{}' is not one of InterceptorComp's and has no effect; "
                                        "of a port it has keep_last, wait_ms and deadline_ms",
                                        parameter));
    return lines;
}

} // namespace tandem::interceptor
