// SPDX-License-Identifier: Apache-2.0
// The repository that a component's folder belongs to: where the headers of its neighbours are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// The nearest folder at or above this one that is the top of a checkout (of git, Mercurial or Subversion); "" without one.
std::filesystem::path find_checkout(const std::filesystem::path& folder);

/// The folders from the top of the checkout down to this one; only this one if it lies in none.
std::vector<std::filesystem::path> ancestors_in_checkout(const std::filesystem::path& folder);

/// Whether the folder has headers of OPRoS's or OpenRTM-aist's own, which must not hide Tandem's.
bool has_upstream_api(const std::filesystem::path& folder);

/// The header that a source includes as `name`, anywhere in the checkout but in upstream's own folders: one file of each
/// content, of those whose path ends with the most of the name. Empty if there is none.
std::vector<std::filesystem::path> find_in_checkout(const std::filesystem::path& checkout,
                                                    const std::string& name);

/// The sources in the checkout that define a function, by its name as the linker writes it: with namespaces and
/// parameters.
std::vector<std::filesystem::path> find_definitions(const std::filesystem::path& checkout,
                                                    const std::string& symbol);

/// The folders that the compiler would find the header in, were they named with -I: in the checkout, else beside the
/// component's folder.
std::vector<std::filesystem::path> folders_with(const std::filesystem::path& component_folder,
                                                const std::string& header);

} // namespace tandem::command
