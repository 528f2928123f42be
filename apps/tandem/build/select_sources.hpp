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

struct SelectedSources {
    std::vector<std::filesystem::path> sources; ///< absolute
    /// In the component's folder, but in none of its project files, which are named.
    std::vector<std::filesystem::path> left_out;
    std::string project_files;
};

/// The sources of the component in `folder` whose library exports `entry_point` (getComponent, XInit): those in the
/// folder and its src/, else those beside the source that defines the function. When the folder's project files list
/// that source, what they list. Throws std::runtime_error if there is none or several define the function.
SelectedSources select_sources(const std::filesystem::path& folder, const std::string& entry_point,
                               const SourceOptions& options);

} // namespace tandem::command
