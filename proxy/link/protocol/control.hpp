// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The control commands: requests with an empty port name, by which AdaptorComp drives the RTC behind
/// InterceptorComp and learns of its errors. The operation of the request is one of these words; arguments
/// are in CDR.
namespace tandem::link::control {

// Executed by InterceptorComp.
inline constexpr std::string_view activate = "activate";     ///< no arguments; ok when the RTC is ACTIVE
inline constexpr std::string_view deactivate = "deactivate"; ///< no arguments; ok when it is INACTIVE
inline constexpr std::string_view reset = "reset";           ///< no arguments; ok when it has left ERROR
inline constexpr std::string_view bind = "bind";     ///< a ServiceBinding: what a required service now offers
inline constexpr std::string_view listen = "listen"; ///< names of the data ports whose messages ring the bell

/// How long InterceptorComp waits for the callback of the RTC, unless its call_timeout is longer: a device may need
/// seconds to open. Below the 10 s after which opros_host gives an onStop up.
inline constexpr std::chrono::milliseconds activation_timeout{10'000}, deactivation_timeout{5'000};

// Executed by AdaptorComp.
inline constexpr std::string_view failed = "failed"; ///< a string for the log: the RTC went to ERROR

/// What an OPRoS component provides for a service that the RTC requires.
struct ServiceBinding {
    std::string port;
    std::vector<ServiceOperation> operations;
};
std::vector<std::byte> encode(const ServiceBinding&);
ServiceBinding decode_service_binding(std::span<const std::byte>); ///< Throws LinkError when damaged.

std::vector<std::byte> encode(const std::vector<std::string>& port_names);
std::vector<std::string> decode_port_names(std::span<const std::byte>); ///< Throws LinkError when damaged.

std::vector<std::byte> encode_string(std::string_view text);
std::string decode_string(std::span<const std::byte>); ///< empty when damaged

} // namespace tandem::link::control
