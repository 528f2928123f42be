// SPDX-License-Identifier: Apache-2.0
// Running code of components in a child process of `tandem` (see host/plugin), so that its crash or hang is an error
// message. Each task has a function for the parent, which starts the child and returns its answer, and one for
// the child.
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/plugin/probe.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>

namespace tandem::command {

/// Task of one component library. Argument: JSON with "profile" (file, or "" to set no properties), "initialize" and
/// "plugin_dirs". Result: describe_component().
constexpr char describe_task[] = "describe-opros";
/// Task of an application, whose profile takes the place of the library. Argument: JSON with "plugin_dirs",
/// "initialize", "excluded", the names of components to leave out, "port_tables", and optionally "trials". Result: a list
/// of errors, one for each refused connection or for each trial.
constexpr char connect_task[] = "connect-opros";

/// Describes the component in this library. Throws plugin::Error.
nlohmann::json describe_in_child(const std::filesystem::path& library, const std::filesystem::path& profile,
                                 const InspectOptions& options);
/// Creates the components of the application but the excluded ones and connects them; returns an error for each
/// connection that is refused. `port_tables`: the ports of each AdaptorComp, as link::encode_as_text(). Throws
/// plugin::Error.
std::vector<std::string> check_connections_in_child(const std::vector<std::string>& excluded,
                                                    const std::map<std::string, std::string>& port_tables,
                                                    const InspectOptions& options);

/// The tasks themselves. [child process]
/// They name each stage by report.begin_stage() before it runs and give their result to report.finish(). What they
/// throw is reported to the parent by serve_probe().
void serve_describe(const plugin::ProbeTask& task, plugin::ProbeReport& report);
void serve_connect(const plugin::ProbeTask& task, plugin::ProbeReport& report);

/// A connection to be tried, as of a profile.
struct TrialConnection {
    PortType type = OPROS_DATA;
    engine::PortReference source, target;
};
/// As check_connections_in_child(), but makes each of these connections alone, and none of the application's own.
/// Returns why each of them is refused, without a file's name; "" for one that is made.
std::vector<std::string> try_connections_in_child(const std::vector<TrialConnection>& trials,
                                                  const std::vector<std::string>& excluded,
                                                  const std::map<std::string, std::string>& port_tables,
                                                  const InspectOptions& options);

} // namespace tandem::command
