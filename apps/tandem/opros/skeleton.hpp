// SPDX-License-Identifier: Apache-2.0
// The texts of a new component; @NAME@ stands for its name.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tandem::command {

/// File names and contents.
std::vector<std::pair<std::string, std::string>> component_skeleton(const std::string& name);

} // namespace tandem::command
