// SPDX-License-Identifier: Apache-2.0
// Finds libraries that are installed in folders which the compiler does not search.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::command {

/// What a component needs to use an installed library.
struct InstalledLibrary {
    std::filesystem::path include_dir;
    std::string package;                          ///< of Debian; "" if unknown
    std::string pkg_config;                       ///< module; "" if unknown
    std::vector<std::filesystem::path> libraries; ///< to link; empty if a module names them
};

/// Returns the library with a header that the compiler does not find. `root`: folder with usr/ and var/.
std::optional<InstalledLibrary> find_installed_library(const std::string& header,
                                                       const std::filesystem::path& root = "/");

/// Returns the library whose folder contains the header beside one of `names`, which the same component includes. The header has
/// no folder in its name, and headers of several packages may have this name.
std::optional<InstalledLibrary> find_installed_beside(const std::string& header,
                                                      const std::set<std::string>& names,
                                                      const std::filesystem::path& root = "/");

/// Returns the files of a Debian package; none if it is not installed.
std::vector<std::filesystem::path> installed_files(std::string_view package,
                                                   const std::filesystem::path& root = "/");

} // namespace tandem::command
