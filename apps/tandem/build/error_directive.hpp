// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::command {

/// Returns the macros around the #error in a compiler's error line. Defining any one of them skips the
/// #error.
std::vector<std::string> macros_that_avoid(const std::string& error);

} // namespace tandem::command
