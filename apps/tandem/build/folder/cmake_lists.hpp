// SPDX-License-Identifier: Apache-2.0
// Reads a CMakeLists.txt without running it, as far as possible.
#pragma once

#include "apps/tandem/build/folder/cmake_commands.hpp"

namespace tandem::command {

/// The words of a command that lists the sources of a target. A pattern (GLOB) is unknown_files.
struct CMakeTarget {
    Words words;
    bool is_program = false;
};
inline const std::string unknown_files = "*";

struct CMakeLists {
    std::vector<CMakeTarget> targets; ///< of the folder's own file
    Words definitions;                ///< NAME or NAME=VALUE
};

/// Reads the CMakeLists.txt of the folder and, in a checkout, those above it, which define variables and macros for
/// it. Branches of if() for other platforms are skipped. Branches with an unknown condition define nothing for the
/// compiler, and no variable that is defined already.
CMakeLists read_cmake_lists(const std::filesystem::path& folder);

} // namespace tandem::command
