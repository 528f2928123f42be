// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/build/folder/cmake_commands.hpp"

namespace tandem::command {

enum class Truth { no, yes, unknown };

/// Evaluates the condition of if() as on Linux with GCC. Returns unknown if it depends on a variable that is not in
/// `variables` or on a test that is not supported.
Truth evaluate_condition(const std::string& text, const Variables& variables);

} // namespace tandem::command
