// SPDX-License-Identifier: Apache-2.0
// The running hosts of OPRoS components, and requests to them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// Options of all commands for running components.
struct OprosClientOptions {
    double timeout_s = 5; ///< time limit of each request
    bool json = false;
};

/// A running opros_host of this user on this machine.
struct OprosHost {
    pid_t pid;
    std::filesystem::path socket;
    /// {"pid", "application", "profile", "components": [{"name", "type", "state", "callback", "executor", "period_ms"}]};
    /// null if the host does not answer.
    nlohmann::json list;
    std::string error; ///< if the host does not answer, in one line
};

/// Asks all hosts for their components. Removes the sockets of hosts that have ended.
std::vector<OprosHost> find_opros_hosts(const OprosClientOptions& options);

/// A component of a running host.
struct RunningComponent {
    OprosHost host;
    std::string name;
};

/// Finds a component by `NAME`, or by `HOST/NAME` with the process id or the application of its host. Throws
/// std::runtime_error, one line, if there is none or several.
RunningComponent find_running_component(const OprosClientOptions& options, const std::string& name);

/// Sends {"command": `command`, "component": ...} with the members of `more` to the component's host. Returns the reply.
/// Throws std::runtime_error with the error of the reply, or if the host does not answer.
nlohmann::json request_component(const OprosClientOptions& options, const RunningComponent& component,
                                 const std::string& command,
                                 const nlohmann::json& more = nlohmann::json::object());

} // namespace tandem::command
