// SPDX-License-Identifier: Apache-2.0
// The device library that a component opens itself: a property such as APIName names it. All functions [any-thread].
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"

#include <PropertyInterface.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::engine {

/// Returns whether a property of this name names a device library. Compares the end of the name and ignores case: ApiName,
/// DllName, and prefixed forms such as LaserApiName.
bool is_device_library_property(std::string property);

/// Returns the folders of the component's library and device library: that of the profile first.
std::vector<std::filesystem::path> search_dirs(const ComponentProfile& profile,
                                               const std::vector<std::filesystem::path>& plugin_dirs);

/// Returns "; did you mean X?" with the library in the folders whose name is most similar, or an empty string.
std::string nearest_library(const std::string& name, const std::vector<std::filesystem::path>& dirs);

/// Returns which setting a component lacks whose callback has returned the error `code` in this thread: a device library
/// that does not exist, or the last missing property that it requested since forget_absent_property(). Begins with "; ",
/// for the end of a message; empty if neither is missing.
std::string describe_missing_setting(ReturnType code, PropertyInterface& component,
                                     const ComponentProfile& profile,
                                     const std::vector<std::filesystem::path>& plugin_dirs);
void forget_absent_property();

} // namespace tandem::engine
