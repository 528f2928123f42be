// SPDX-License-Identifier: Apache-2.0
// Names of what a child process of `tandem` does with components, and how the parent asks for it.
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "host/plugin/probe.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace tandem::command {

/// Argument: a component profile's file if properties shall be set, and --initialize. Result: describe().
constexpr char describe_task[] = "describe-opros";
/// The library is the application's profile. Arguments: JSON with "plugin_dirs", "initialize", and "without",
/// the components to be left out. Result: a list of lines, what does not fit.
constexpr char connect_task[] = "connect-opros";

/// What the component in this library shows, made in a child process. Throws plugin::Error.
nlohmann::json describe_in_child(const std::filesystem::path& library, const std::filesystem::path& profile,
                                 const InspectOptions& options);
/// Throws plugin::Error.
std::vector<std::string> check_connections_in_child(const std::vector<std::string>& without,
                                                    const InspectOptions& options);

void serve_describe(const plugin::ProbeTask& task, plugin::ProbeReport& report);
void serve_connect(const plugin::ProbeTask& task, plugin::ProbeReport& report);

} // namespace tandem::command
