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

/// The control commands: requests with an empty port name. Each proxy uses them to drive the components that the
/// other proxy shares and to learn their states. The operation of the request is one of these words; the arguments
/// are in CDR. A side shares its components as a group, whose states only the group's own model knows and whose failure
/// it reports (`failed`), or one by one, with a StateReport for each.
namespace tandem::link::control {

// The side that shares the components executes these. Without arguments: for all of them. With the name of a component:
// for this one; the reply is a StateReport.
inline constexpr std::string_view activate = "activate";     ///< ok if it is active
inline constexpr std::string_view deactivate = "deactivate"; ///< ok if it is inactive
inline constexpr std::string_view reset = "reset";           ///< ok if it has left its error state
inline constexpr std::string_view listen = "listen"; ///< names of the data ports whose messages ring the bell

/// How long a command may wait for the callback of a component, unless the call_timeout of the side that executes it is
/// longer: a device may need seconds to open. A host that stops a component gives up after 10 s, so deactivation_timeout
/// is below that.
inline constexpr std::chrono::milliseconds activation_timeout{10'000}, deactivation_timeout{5'000};

/// How long a command for all components waits for one of them before it starts with the next one in parallel.
inline constexpr std::chrono::milliseconds head_start{100};

/// Returns how long a proxy waits for the other proxy's own work. `call_timeout` bounds the calls of components and
/// may be shorter than the time that a newly started host needs on a busy machine.
inline std::chrono::milliseconds command_timeout(std::chrono::milliseconds call_timeout) {
    return std::max(call_timeout, std::chrono::milliseconds(1'000));
}

/// A ServiceBinding: the current operations of a required service, or of the interface that a component requires.
inline constexpr std::string_view bind = "bind";
inline constexpr std::string_view exit = "exit";           ///< name of a component, which is destroyed
inline constexpr std::string_view configure = "configure"; ///< a Setting

// The side that drives the components of the peer executes these.
inline constexpr std::string_view state = "state"; ///< a StateReport: a component has changed its state
inline constexpr std::string_view failed =
    "failed"; ///< a string for the log: a component of the group has failed or has exited
inline constexpr std::string_view recovered =
    "recovered"; ///< after `failed` or a refused `activate`: all components of the group are active

/// The state of a shared component, reduced to the needs of the component that represents it on the other side.
enum class ComponentState : std::uint32_t { inactive, active, error, destroyed };

struct StateReport {
    std::string component;
    ComponentState state{};
    std::uint64_t sequence = 0; ///< in a session, the report with the larger number is newer
};
std::vector<std::byte> encode(const StateReport&);
StateReport decode_state_report(std::span<const std::byte>); ///< Throws LinkError if damaged.

/// A new value of a component's property.
struct Setting {
    std::string component, name, value;
};
std::vector<std::byte> encode(const Setting&);
Setting decode_setting(std::span<const std::byte>); ///< Throws LinkError if damaged.

/// The operations that a component provides for a service that a shared component requires, or the operations of the
/// interface that a shared component requires. Empty if they are unknown.
struct ServiceBinding {
    std::string port;
    std::vector<ServiceOperation> operations;
};
std::vector<std::byte> encode(const ServiceBinding&);
ServiceBinding decode_service_binding(std::span<const std::byte>); ///< Throws LinkError if damaged.

std::vector<std::byte> encode(const std::vector<std::string>& port_names);
std::vector<std::string> decode_port_names(std::span<const std::byte>); ///< Throws LinkError if damaged.

std::vector<std::byte> encode_string(std::string_view text);
std::string decode_string(std::span<const std::byte>); ///< Returns an empty string if damaged.

} // namespace tandem::link::control
