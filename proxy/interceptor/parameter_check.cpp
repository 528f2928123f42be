// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/parameter_check.hpp"

#include "proxy/link/protocol/port_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace tandem::interceptor {
namespace {

constexpr link::PortSetting port_parameters[] = {link::keep_last_setting, link::wait_ms_setting,
                                                 link::deadline_ms_setting};
constexpr link::PortSettings settings{"parameter", "AdaptorComp", true, port_parameters};

constexpr std::string_view own_parameters[] = {"link",     "rtc",       "manage",      "call_timeout",
                                               "ring_kib", "large_kib", "segment_mib", "group",
                                               "strict",   "keep_last", "wait_ms",     "deadline_ms"};

/// Keys of an RTC's profile, and keys that its manager reads for every RTC. A name also permits keys that begin
/// with it and a dot.
constexpr std::string_view of_manager[] = {"implementation_id",
                                           "type_name",
                                           "description",
                                           "version",
                                           "vendor",
                                           "category",
                                           "activity_type",
                                           "kind",
                                           "max_instance",
                                           "language",
                                           "lang_type",
                                           "instance_name",
                                           "config_file",
                                           "manager_name",
                                           "manager_address",
                                           "publish_topic",
                                           "subscribe_topic",
                                           "rendezvous_point",
                                           "execution_contexts",
                                           "conf",
                                           "config",
                                           "configuration",
                                           "corba",
                                           "ec",
                                           "exec_cxt",
                                           "logger",
                                           "manager",
                                           "naming",
                                           "openrtm",
                                           "os",
                                           "port",
                                           "sdo"};

template <class Names>
bool contains(const Names& names, std::string_view name) {
    return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

bool is_known(std::string_view parameter) {
    return contains(own_parameters, parameter) || settings.find(parameter) ||
           contains(of_manager, parameter.substr(0, parameter.find('.')));
}

} // namespace

std::vector<std::string> find_useless_parameters(const std::vector<std::string>& parameters,
                                                 const link::PortTable& own) {
    auto lines = link::find_settings_without_port(parameters, own, settings);
    for (const auto& parameter : parameters)
        if (!is_known(parameter))
            lines.push_back(
                fmt::format("parameter '{}' is not one of InterceptorComp's and has no effect; {}", parameter,
                            parameter.find('.') == std::string::npos
                                ? fmt::format("it has {}", fmt::join(own_parameters, ", "))
                                : "of a port it has keep_last, wait_ms and deadline_ms"));
    return lines;
}

} // namespace tandem::interceptor
