// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace tandem::command {

/// The profile of an application, composite, service type or data type as JSON. "kind" is which; application and
/// composite have "name" and "components", and "connections" or "ports"; the types "types" with "methods" or
/// "fields". The ports of a composite are typed as in the code of its components, which is run in a child process.
/// Throws engine::SetupError.
nlohmann::json describe_profile(engine::ProfileKind kind, const InspectOptions& options);
/// The same as text.
std::string format_profile(const nlohmann::json& info);

} // namespace tandem::command
