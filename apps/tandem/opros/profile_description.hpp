// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/opros/commands.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace tandem::command {

/// What a profile says that is no component's: a composite (with the ports that it exports, as its
/// components' code has them), an application, a service type or a data type. Throws engine::SetupError.
nlohmann::json describe_profile(engine::ProfileKind kind, const InspectOptions& options);
std::string format_profile(const nlohmann::json& info);

} // namespace tandem::command
