// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"

namespace tandem::engine {

/// Replaces each composite of the application by its components, to any depth, so that the rest of the engine
/// knows components only. Component B of composite A is named A.B, a connection to an exported port goes to the
/// port behind it, and a dependency on a composite is one on each of its components. Each subcomponent of the
/// result has its file. Throws SetupError: a profile is missing or wrong, a composite contains itself or has
/// properties, or there are more than 1000 components.
ApplicationProfile flatten_composites(const ApplicationProfile& application,
                                      const std::vector<std::filesystem::path>& plugin_dirs);

/// Whether one of the application's own components is a composite. A profile that is missing or cannot be read
/// counts as none: this function does not throw for it.
bool has_composites(const ApplicationProfile& application,
                    const std::vector<std::filesystem::path>& plugin_dirs);

} // namespace tandem::engine
