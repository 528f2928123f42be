// SPDX-License-Identifier: Apache-2.0
// Searches the repository that contains a component's folder for headers and sources of other components.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Returns the nearest folder at or above `folder` that is the top of a checkout (git, Mercurial,
/// Subversion); "" if none.
std::filesystem::path find_checkout(const std::filesystem::path& folder);

/// Returns the folders from the top of the checkout down to `folder`; only `folder` outside of a checkout.
std::vector<std::filesystem::path> ancestors_in_checkout(const std::filesystem::path& folder);

/// Returns whether the folder contains headers of OPRoS or OpenRTM-aist, which must not hide Tandem's.
bool has_upstream_api(const std::filesystem::path& folder);

/// Returns the headers and IDL files in the checkout that `#include "name"` can mean: the files whose paths match the
/// longest end of `name`. Skips folders with upstream headers, and returns files with equal content once.
std::vector<std::filesystem::path> find_in_checkout(const std::filesystem::path& checkout,
                                                    const std::string& name);

/// Returns the sources among the files that define a function, those with equal content once. `symbol`: its name as
/// the linker prints it, with namespaces and parameters.
std::vector<std::filesystem::path> find_definitions(const std::vector<std::filesystem::path>& files,
                                                    const std::string& symbol);

/// Returns the folders of the checkout's git submodules that are empty or missing, as .gitmodules names them.
std::vector<std::string> missing_submodules(const std::filesystem::path& checkout);

/// Returns the folders to name with -I so that the compiler finds the header or omniidl the IDL file: in the checkout,
/// or else in or beside the component's folder.
std::vector<std::filesystem::path> folders_with(const std::filesystem::path& component_folder,
                                                const std::string& header);

} // namespace tandem::command
