// SPDX-License-Identifier: Apache-2.0
// Reads the project files in a component's folder (CMakeLists.txt, makefiles, configure.ac, Visual C++ projects) without
// running them. Skips what cannot be read without running them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// The sources that one target of a CMakeLists.txt, one variable of a makefile or one Visual C++ project lists.
struct SourceList {
    std::filesystem::path project_file;
    std::vector<std::filesystem::path> sources; ///< absolute; only those that exist
    bool for_windows = false;                   ///< from Visual C++
    bool is_program = false;                    ///< the target of a CMakeLists.txt is one
};

/// Returns the lists of the project files in the folder itself. Omits lists with a pattern (GLOB, wildcard).
std::vector<SourceList> read_source_lists(const std::filesystem::path& folder);

/// Returns the existing include folders that the folder's makefiles and Visual C++ projects name, as absolute
/// paths.
std::vector<std::filesystem::path> read_include_dirs(const std::filesystem::path& folder);

/// Returns the definitions, NAME or NAME=VALUE, that the CMakeLists.txt of the folder and of those above it in the checkout
/// make. A configure.ac that is nearer than any CMakeLists.txt is read instead.
std::vector<std::string> read_definitions(const std::filesystem::path& folder);

} // namespace tandem::command
