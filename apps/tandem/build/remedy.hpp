// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace tandem::command {

/// What the failed build used.
struct BuildFacts {
    std::filesystem::path folder;                     ///< of the component
    std::vector<std::string> pkg_config, libraries{}; ///< modules, and names after -l
    std::filesystem::path root = "/";                 ///< folder with usr/ and var/
    std::set<std::string> unknown{}; ///< included names that no folder of the component contains
};

/// Returns advice for an error of the compiler or linker, for example the Debian package or the neighbouring
/// component with the missing header or library; "" if there is none. Advises nothing that the build has used.
std::string find_remedy(const std::string& error, const BuildFacts& facts);

/// Returns the Debian package that the remedy installs; "" if it is another remedy.
std::string package_to_install(const std::string& remedy);

/// Returns the name of OpenCV's C API that the compiler does not know; "" for errors about other names.
std::string dropped_by_opencv(const std::string& error);

} // namespace tandem::command
