// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The control commands: requests with an empty port name, by which each proxy drives the components that the other
/// one shares and learns of their states. The operation of the request is one of these words; arguments are in CDR.
namespace tandem::link::control {

// Executed by both. InterceptorComp: for all its RTCs, without arguments. AdaptorComp: for the OPRoS component whose
// name is the argument; the reply is a StateReport.
inline constexpr std::string_view activate = "activate";     ///< ok when it is active
inline constexpr std::string_view deactivate = "deactivate"; ///< ok when it is inactive
inline constexpr std::string_view reset = "reset";           ///< ok when it has left its error state
inline constexpr std::string_view listen = "listen"; ///< names of the data ports whose messages ring the bell

/// How long InterceptorComp waits for the callback of the RTC, unless its call_timeout is longer: a device may need
/// seconds to open. Below the 10 s after which opros_host gives an onStop up.
inline constexpr std::chrono::milliseconds activation_timeout{10'000}, deactivation_timeout{5'000};

/// How long it waits for one RTC before it goes on to the next one, beside it.
inline constexpr std::chrono::milliseconds head_start{100};

/// How long a proxy waits for what the other one does by itself. `call_timeout` bounds the calls of components and may be short; a
/// host that has just come may be later than that on a busy machine.
inline std::chrono::milliseconds command_timeout(std::chrono::milliseconds call_timeout) {
    return std::max(call_timeout, std::chrono::milliseconds(1'000));
}

/// A ServiceBinding: what a required service now offers; from InterceptorComp, the operations of its interface.
inline constexpr std::string_view bind = "bind";

// Executed by InterceptorComp.
inline constexpr std::string_view state =
    "state"; ///< a StateReport: an OPRoS component has changed its state

// Executed by AdaptorComp.
inline constexpr std::string_view failed =
    "failed";                                    ///< a string for the log: an RTC went to ERROR or has exited
inline constexpr std::string_view exit = "exit"; ///< name of an OPRoS component, which is destroyed
inline constexpr std::string_view configure = "configure"; ///< a Setting

/// The state of an OPRoS component, as far as it concerns an RTC that shows it.
enum class ComponentState : std::uint32_t { inactive, active, error, destroyed };

struct StateReport {
    std::string component;
    ComponentState state{};
    std::uint64_t sequence =
        0; ///< of two reports of one session about a component, the one with the larger is newer
};
std::vector<std::byte> encode(const StateReport&);
StateReport decode_state_report(std::span<const std::byte>); ///< Throws LinkError when damaged.

/// A new value of a component's property.
struct Setting {
    std::string component, name, value;
};
std::vector<std::byte> encode(const Setting&);
Setting decode_setting(std::span<const std::byte>); ///< Throws LinkError when damaged.

/// What an OPRoS component provides for a service that the RTC requires, or the operations of the interface that a shared
/// OPRoS component requires; none if its IDL is not known.
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
