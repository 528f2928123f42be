// SPDX-License-Identifier: Apache-2.0
// What `tandem opros new` and `tandem rtm new` have in common.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tandem::command {

using TemplateFiles = std::vector<std::pair<std::string, std::string>>; ///< file name, content

/// Throws std::runtime_error if the name cannot be that of a class, a library and files.
void require_component_name(const std::string& name);

/// Makes the folder with these files, or nothing. Throws std::runtime_error if it exists or cannot be made.
void create_component_folder(const std::filesystem::path& folder, const TemplateFiles& files);

/// `text` with each @NAME@ replaced.
std::string expand_template(std::string text, const std::string& name);

} // namespace tandem::command
