// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <string>

namespace tandem::command {

/// "periodic", "passive", ...
std::string to_string(engine::ExecutionType execution);
/// "periodic, 10 ms, priority 7"
std::string format_executor(const engine::ComponentProfile& profile);

} // namespace tandem::command
