// SPDX-License-Identifier: Apache-2.0
// What the project files in a component's folder say: CMakeLists.txt, makefiles, projects of Visual C++. None of them is
// run; what cannot be read without running it is passed over.
#pragma once

#include <filesystem>
#include <vector>

namespace tandem::command {

/// The sources that one target of a CMakeLists.txt, one variable of a makefile or one Visual C++ project lists.
struct SourceList {
    std::filesystem::path project_file;
    std::vector<std::filesystem::path> sources; ///< absolute; only those that exist
    bool for_windows = false;                   ///< of Visual C++
};

/// The lists of the project files that lie in the folder itself. A list with a pattern (GLOB, wildcard) is left out.
std::vector<SourceList> read_source_lists(const std::filesystem::path& folder);

/// The folders of headers that its makefiles and Visual C++ projects name and that exist, absolute.
std::vector<std::filesystem::path> read_include_dirs(const std::filesystem::path& folder);

} // namespace tandem::command
