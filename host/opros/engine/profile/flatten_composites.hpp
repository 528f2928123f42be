// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"

namespace tandem::engine {

/// Replaces each composite of the application by its components, at any depth, so that the rest of the engine handles
/// components only. Component B of composite A is named A.B. A connection to an exported port goes to the port behind
/// it. A dependency on a composite becomes a dependency on each of its components. Each subcomponent of the result
/// has its file or missing_profile set. Throws SetupError if a profile is wrong, the profile of a component without a
/// node is missing, a composite contains itself or has properties, or there are more than 1000 components.
ApplicationProfile flatten_composites(const ApplicationProfile& application,
                                      const std::vector<std::filesystem::path>& plugin_dirs);

/// Returns true if one of the application's direct components is a composite. A missing or unreadable profile counts
/// as no composite: this function does not throw for it.
bool has_composites(const ApplicationProfile& application,
                    const std::vector<std::filesystem::path>& plugin_dirs);

} // namespace tandem::engine
