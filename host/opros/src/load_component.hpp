// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/src/profile.hpp"
#include "host/plugin/library.hpp"

#include <Component.h>

#include <memory>

namespace tandem::engine {

struct LoadedComponent {
    std::shared_ptr<plugin::Library> library;
    std::shared_ptr<Component> component; ///< keeps the library loaded, too
};

/// Finds the library beside the profile or in one of the folders, and makes a component. Throws SetupError
/// with the place of the library's name.
LoadedComponent load_component(const ComponentProfile& profile,
                               const std::vector<std::filesystem::path>& dirs);

} // namespace tandem::engine
