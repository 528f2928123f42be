// SPDX-License-Identifier: Apache-2.0
// Two components to join, found in their folders.
#pragma once

#include "apps/tandem/link/commands.hpp"
#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <string>

namespace tandem::command {

struct ComponentPair {
    engine::ComponentProfile opros; ///< its location.file is absolute
    std::filesystem::path library;  ///< of the OPRoS component
    std::filesystem::path module;   ///< of the RTC, absolute
    std::string type, category;     ///< of the RTC
};

/// Finds out which of the two is which. Throws std::runtime_error: a folder has no built component, both are of one model,
/// or there are several to choose from.
ComponentPair find_component_pair(const LinkProfileOptions& options);

} // namespace tandem::command
