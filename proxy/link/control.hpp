// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/port_table.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The control commands: requests with an empty port name, by which AdaptorComp drives the RTC behind
/// InterceptorComp and hears of it.
namespace tandem::link::control {

inline constexpr std::string_view activate = "activate";     ///< no arguments; ok when the RTC is ACTIVE
inline constexpr std::string_view deactivate = "deactivate"; ///< no arguments; ok when it is INACTIVE
inline constexpr std::string_view reset = "reset";           ///< no arguments; ok when it has left ERROR
inline constexpr std::string_view bind = "bind";     ///< a ServiceBinding: what a required service now offers
inline constexpr std::string_view failed = "failed"; ///< a string: the RTC went to ERROR

struct ServiceBinding {
    std::string port;
    std::vector<ServiceOperation> operations;
};
std::vector<std::byte> encode(const ServiceBinding&);
ServiceBinding decode_service_binding(std::span<const std::byte>); ///< Throws LinkError when damaged.

std::vector<std::byte> encode_string(std::string_view text);
std::string decode_string(std::span<const std::byte>);

} // namespace tandem::link::control
