// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace tandem::command {

/// A profile as JSON that is not of a component: of a composite (with the ports that it exports, typed as in the code of
/// its components, which is run in a child process), an application, a service type or a data type. Throws
/// engine::SetupError.
/// "kind" tells the form: application and composite have "name" and "components", the first with "connections", the
/// second with "ports"; service types have "types" with "methods", data types "types" with "fields".
nlohmann::json describe_profile(engine::ProfileKind kind, const InspectOptions& options);
/// The same as text.
std::string format_profile(const nlohmann::json& info);

} // namespace tandem::command
