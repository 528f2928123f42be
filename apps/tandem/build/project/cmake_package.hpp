// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tandem::command {

/// Returns the folder of this program's TandemConfig.cmake. The search starts at the program's own file, so
/// that an installed tree can be moved. Throws std::runtime_error if it is missing.
std::filesystem::path cmake_package_folder();

} // namespace tandem::command
