// SPDX-License-Identifier: Apache-2.0
// The texts of a new RT-Component; @NAME@ stands for its name.
#pragma once

#include "apps/tandem/build/new_folder.hpp"

namespace tandem::command {

FilesWithText rtc_skeleton(const std::string& name);

} // namespace tandem::command
