// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <string>

namespace tandem::command {

/// "periodic", "passive", ...
std::string execution_word(engine::ExecutionType execution);
/// "periodic, 10 ms, priority 7"
std::string executor_text(const engine::ComponentProfile& profile);

} // namespace tandem::command
