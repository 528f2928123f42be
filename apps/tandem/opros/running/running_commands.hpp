// SPDX-License-Identifier: Apache-2.0
// The sub-commands of `tandem opros` for components of a running opros_host. Each function prints its result and returns
// the exit code. Each throws std::runtime_error with a one-line message.
#pragma once

#include "apps/tandem/opros/running/opros_hosts.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tandem::command {

/// Prints every component of the hosts of this user, with its state. Then throws if no host has answered.
int opros_list(const OprosClientOptions& options);

/// Returns whether the argument of `tandem opros info` can only be a running component: there is no such file, and it has
/// no suffix of a library or a profile.
bool names_running_component(const std::filesystem::path& argument);
/// Prints state, period, ports, connections and properties of a component.
int opros_running_info(const OprosClientOptions& options, const std::string& component);

/// Makes a transition of each component in turn: `start`, `stop` or `recover`. Ends at the first that fails; earlier
/// components remain changed.
int opros_transition(const OprosClientOptions& options, const std::vector<std::string>& components,
                     const std::string& command);

/// Options of `tandem opros conf`.
struct OprosConfOptions {
    std::string component;
    std::string name;                 ///< empty: all properties; may be NAME=VALUE
    std::optional<std::string> value; ///< to set
};
/// Prints properties of a component after setting one, if the options say so.
int opros_conf(const OprosClientOptions& client_options, const OprosConfOptions& options);

/// Adds list, start, stop, recover and conf. `selected`: see apps/tandem/commands.hpp.
void add_running_opros_commands(CLI::App& opros, std::function<int()>& selected);

} // namespace tandem::command
