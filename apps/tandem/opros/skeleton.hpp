// SPDX-License-Identifier: Apache-2.0
// The texts of a new component; @NAME@ stands for its name.
#pragma once

#include "apps/tandem/build/new_folder.hpp"

namespace tandem::command {

FilesWithText component_skeleton(const std::string& name);

} // namespace tandem::command
