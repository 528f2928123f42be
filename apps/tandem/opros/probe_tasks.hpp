// SPDX-License-Identifier: Apache-2.0
// Runs code of components in a child process of `tandem` (see host/plugin), so that its crash or hang becomes an error
// message. Each task has a function for the parent, which starts the child and returns its answer, and one for the
// child.
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/plugin/probe.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>

namespace tandem::command {

/// Task for a component library. Argument: JSON with "profile" (file, or "" to set no properties), "initialize" and
/// "plugin_dirs". Result: describe_component().
constexpr char describe_task[] = "describe-opros";
/// Task for an application. Its profile replaces the library. Argument: JSON with "plugin_dirs", "initialize",
/// "excluded" (names of components to omit), "port_tables", and optionally "trials". Result: a list of errors, one for
/// each refused connection or for each trial.
constexpr char connect_task[] = "connect-opros";

/// Describes the component in this library. Throws plugin::Error.
nlohmann::json describe_in_child(const std::filesystem::path& library, const std::filesystem::path& profile,
                                 const InspectOptions& options);
/// Creates and connects the components of the application, except the excluded ones. Returns an error for each refused
/// connection. `port_tables`: the ports of each AdaptorComp, from link::encode_as_text(). Throws plugin::Error.
std::vector<std::string> check_connections_in_child(const std::vector<std::string>& excluded,
                                                    const std::map<std::string, std::string>& port_tables,
                                                    const InspectOptions& options);

/// Perform the tasks. They call report.begin_stage() before each stage and report.finish() with the result.
/// serve_probe() reports their exceptions to the parent. [child process]
void serve_describe(const plugin::ProbeTask& task, plugin::ProbeReport& report);
void serve_connect(const plugin::ProbeTask& task, plugin::ProbeReport& report);

/// A connection to try.
struct TrialConnection {
    PortType type = OPROS_DATA;
    engine::PortReference source, target;
};
/// Like check_connections_in_child(), but tries each of these connections separately and none of the application's.
/// Returns the reason of each refusal, without a file name; "" for a possible connection.
std::vector<std::string> try_connections_in_child(const std::vector<TrialConnection>& trials,
                                                  const std::vector<std::string>& excluded,
                                                  const std::map<std::string, std::string>& port_tables,
                                                  const InspectOptions& options);

} // namespace tandem::command
