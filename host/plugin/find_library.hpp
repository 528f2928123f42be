// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::plugin {

/// Returns the file names that a library of this name may have. Profiles of existing components write a library's
/// name as X, X.so, libX.so, X.dll or libX.dll.so, independent of its actual file name.
std::vector<std::string> library_file_names(const std::string& name);

/// Searches the folders in order and returns the first file with one of these names. A name with a folder is relative
/// to each search folder. An absolute name is used as is. Throws Error not_found with the searched names and folders.
/// [any-thread]
std::filesystem::path find_library(const std::string& name,
                                   const std::vector<std::filesystem::path>& search_dirs);

} // namespace tandem::plugin
