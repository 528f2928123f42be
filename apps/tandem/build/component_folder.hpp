// SPDX-License-Identifier: Apache-2.0
// Creates the folder of a new component for `tandem opros new` and `tandem rtm new`.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tandem::command {

using TemplateFiles = std::vector<std::pair<std::string, std::string>>; ///< file name, content

/// Throws std::runtime_error unless the name is valid for a C++ class, a library and files.
void require_component_name(const std::string& name);

/// Creates the folder with these files. Leaves nothing behind on an error. Throws std::runtime_error if the
/// folder exists or cannot be created, or if its header would hide a system header.
void create_component_folder(const std::filesystem::path& folder, const TemplateFiles& files);

/// Returns the text with each @NAME@ replaced by the name.
std::string expand_template(std::string text, const std::string& name);

} // namespace tandem::command
