// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <string>

namespace tandem::command {

/// Returns the profile's word: "periodic", "passive", ...
std::string to_string(engine::ExecutionType execution);
/// Returns for example "periodic, every 10 ms, priority 7". Omits zeros and defaults.
std::string format_executor(const engine::ComponentProfile& profile);

} // namespace tandem::command
