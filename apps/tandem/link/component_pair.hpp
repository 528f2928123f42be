// SPDX-License-Identifier: Apache-2.0
// Finds built components in their folders.
#pragma once

#include "apps/tandem/link/commands.hpp"
#include "apps/tandem/shared_ports/rtc_conf_ports.hpp"
#include "host/opros/engine/profile/component_profile.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tandem::command {

/// What a component's folder contains: the modules of an RTC, or the profile of an OPRoS component, or the reason why
/// there is no profile.
struct ComponentFiles {
    std::vector<std::filesystem::path> modules;
    std::optional<engine::ComponentProfile> opros; ///< location.file is absolute
    std::string error;
};

/// Looks into a folder, or at a profile or a module. `profile`: selects one of several. Runs none of its code.
ComponentFiles find_component_files(const std::filesystem::path& place, const std::string& profile = "");

/// Returns the only module, absolute. Throws std::runtime_error if there are several.
std::filesystem::path select_module(const ComponentFiles& files, const std::filesystem::path& place);

/// Returns the component type that a module registers; `name` selects one of several. Loads the module in a child process.
/// Throws std::runtime_error.
RtcType select_type(const std::filesystem::path& module, const std::string& name, double timeout_s);

struct ComponentPair {
    engine::ComponentProfile opros; ///< location.file is absolute
    std::filesystem::path library;  ///< of the OPRoS component
    std::filesystem::path module;   ///< of the RTC, absolute
    std::string type, category;     ///< of the RTC
};

/// Determines which folder contains which model. Throws std::runtime_error if a folder has no built component, if both
/// components are of the same model, or if a choice is ambiguous.
ComponentPair find_component_pair(const LinkProfileOptions& options);

} // namespace tandem::command
