// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tandem::command {

/// The folder of TandemConfig.cmake that belongs to this program, wherever the tree was moved to. Throws
/// std::runtime_error if it is not there.
std::filesystem::path cmake_package_folder();

} // namespace tandem::command
