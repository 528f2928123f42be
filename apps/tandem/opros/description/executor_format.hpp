// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <string>

namespace tandem::command {

/// The word of the profile: "periodic", "passive", ...
std::string to_string(engine::ExecutionType execution);
/// "periodic, every 10 ms, priority 7"; what is zero or the default is left out.
std::string format_executor(const engine::ComponentProfile& profile);

} // namespace tandem::command
