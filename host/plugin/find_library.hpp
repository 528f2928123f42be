// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::plugin {

/// The file names that a library of this name may have. Profiles of existing components name a library as X,
/// X.so, libX.so, X.dll or libX.dll.so, whatever its file is called.
std::vector<std::string> library_file_names(const std::string& name);

/// Searches the folders in order and returns the first file with one of these names. A name that contains a
/// folder is relative to each search folder; an absolute name is used as it is. Throws Error not_found that
/// lists the names and folders tried. [any-thread]
std::filesystem::path find_library(const std::string& name,
                                   const std::vector<std::filesystem::path>& search_dirs);

} // namespace tandem::plugin
