// SPDX-License-Identifier: Apache-2.0
// Reads what CMake's file API says about the targets of a configured project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// A library or program of a CMake project, including what it takes from other libraries of the project.
struct ProjectTarget {
    enum class Kind { plugin, part, program }; ///< part: a static or object library

    std::string name;
    Kind kind = Kind::program;
    std::vector<std::filesystem::path> sources, include_dirs, library_dirs; ///< absolute, existing
    std::vector<std::string> definitions;                                   ///< NAME or NAME=VALUE
    std::vector<std::string> options;   ///< of the compiler; without warnings and optimization
    std::vector<std::string> libraries; ///< names or existing files, from outside the project
    int standard = 0;                   ///< of C++, 0: the compiler's
};

/// Creates the file that asks CMake for the codemodel when it configures `build`. Removes an older answer.
void request_codemodel(const std::filesystem::path& build);

/// Returns the targets in the answer; none if there is no answer or it cannot be read.
std::vector<ProjectTarget> read_codemodel(const std::filesystem::path& build);

} // namespace tandem::command
