// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace tandem::command {

struct MissingLibraries {
    std::set<std::string> modules; ///< of pkg-config
    std::set<std::string> names;   ///< after -l
};

/// Adds the installed libraries with functions that a build's output reports as undefined, and prints notes. Returns whether
/// it added one. `root`: folder with usr/ and var/.
bool add_libraries(const std::string& output, MissingLibraries& libraries,
                   const std::filesystem::path& root = "/");

} // namespace tandem::command
