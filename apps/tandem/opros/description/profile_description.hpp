// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace tandem::command {

/// Returns the profile of an application, composite, service type or data type as JSON. "kind" is its kind.
/// Applications and composites have "name" and "components", and "connections" or "ports"; types have "types" with
/// "methods" or "fields". The types of a composite's ports come from its components' code, which runs in a child
/// process. Throws engine::SetupError.
nlohmann::json describe_profile(engine::ProfileKind kind, const InspectOptions& options);
/// Formats the result of describe_profile() as text.
std::string format_profile(const nlohmann::json& info);

} // namespace tandem::command
