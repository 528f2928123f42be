// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tandem::command {

/// The folder of the TandemConfig.cmake that belongs to this program: found relative to the program's own file,
/// so that an installed tree can be moved. Throws std::runtime_error if it is not there.
std::filesystem::path cmake_package_folder();

} // namespace tandem::command
