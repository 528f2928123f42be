// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tandem::command {

/// The macros each of which, if it were defined, would keep the compiler from an #error, according to the compiler's line
/// about it and to the branches of the preprocessor around that place. Empty if there is none.
std::vector<std::string> macros_that_avoid(const std::string& error);

} // namespace tandem::command
