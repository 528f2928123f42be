// SPDX-License-Identifier: Apache-2.0
// Which sources make the plugin of a component.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

struct SourceOptions {
    std::vector<std::string> sources;  ///< these in place of those that are found; patterns are allowed
    std::vector<std::string> excluded; ///< not these; names or patterns, relative to the component's folder
};

/// The function that a component's library exports.
struct EntryPoint {
    std::string function;           ///< getComponent, XInit
    std::filesystem::path source{}; ///< which defines it, where several do; "": the only one
    /// Those of the folder's other components; sources that define one of them are not built, unless a project file lists
    /// them together with this one's.
    std::vector<std::string> others{};
};

struct SelectedSources {
    std::vector<std::filesystem::path> sources; ///< absolute
    /// In the component's folder, but in none of its project files, which are named.
    std::vector<std::filesystem::path> left_out;
    std::string project_files;
};

/// The sources of the component in `folder` whose library has the entry point: those in the folder and its src/, else
/// those beside the source that defines the function. When the folder's project files list that source, what they list;
/// projects of Visual C++ only where no other does. Throws std::runtime_error if there is none or several define it.
SelectedSources select_sources(const std::filesystem::path& folder, const EntryPoint& entry_point,
                               const SourceOptions& options);

} // namespace tandem::command
