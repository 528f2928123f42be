// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/src/profile.hpp"

#include <Component.h>

#include <memory>

namespace tandem::engine {

/// Finds the library beside the profile or in one of the folders, and makes a component. The instance keeps
/// the library loaded. Throws SetupError with the place of the library's name.
std::shared_ptr<Component> load_component(const ComponentProfile& profile,
                                          const std::vector<std::filesystem::path>& dirs);

} // namespace tandem::engine
