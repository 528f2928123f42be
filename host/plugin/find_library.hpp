// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::plugin {

/// The file names a library of this name may have: profiles in the wild say X, X.so, libX.so, X.dll,
/// libX.dll.so.
std::vector<std::string> library_file_names(const std::string& name);

/// The first folder's first match. A name with a folder in it is taken relative to each search folder, or as
/// it is when absolute. Throws plugin::Error that lists the names and folders tried.
std::filesystem::path find_library(const std::string& name,
                                   const std::vector<std::filesystem::path>& search_dirs);

} // namespace tandem::plugin
