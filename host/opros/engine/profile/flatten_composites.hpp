// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/profile.hpp"

namespace tandem::engine {

/// The application with each composite replaced by its components, to any depth: component B of composite A
/// is named A.B, connections to the composite's exported ports go to the ports behind them, and a dependency
/// on a composite is one on each of its components. All subcomponents have their files. Throws SetupError.
ApplicationProfile flatten_composites(const ApplicationProfile& application,
                                      const std::vector<std::filesystem::path>& plugin_dirs);

/// Whether one of the application's own components is a composite; profiles that cannot be read are none.
bool has_composites(const ApplicationProfile& application,
                    const std::vector<std::filesystem::path>& plugin_dirs);

} // namespace tandem::engine
