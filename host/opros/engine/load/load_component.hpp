// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/profile.hpp"
#include "host/plugin/library.hpp"
#include "host/plugin/probe.hpp"

#include <Component.h>

#include <memory>
#include <optional>

namespace tandem::engine {

struct LoadedComponent {
    std::shared_ptr<plugin::Library> library;
    std::shared_ptr<Component> component; ///< keeps the library loaded, too
};

/// Throws plugin::Error unless the library is an OPRoS component built against our headers. Its code does not
/// run.
void require_opros_component(const std::filesystem::path& library);

/// Loads the library and makes a component. Throws plugin::Error, or SetupError if getComponent() fails.
LoadedComponent instantiate_component(const std::filesystem::path& library);

/// The library of the profile: beside it or in one of the folders. Throws SetupError with the place of its
/// name.
std::filesystem::path find_component_library(const ComponentProfile& profile,
                                             const std::vector<std::filesystem::path>& dirs);

/// Properties that tell a component where it lies: `<profile's folder>/res/` and that folder.
constexpr const char* folder_property_names[] = {"_opros_xx_internal_xx_Component_Path",
                                                 "opros.component.dir"};

/// The component's properties: where it lies, those of its profile, and `more`, which override them. A
/// property that names a device library (APIName, ApiName, DllName and the like) becomes the path of the
/// file, found as the component's own library is, or stays as it is if there is none.
void set_component_properties(Component& component, const ComponentProfile& profile, const Properties& more,
                              const std::vector<std::filesystem::path>& dirs);

/// Both, the library tried in a child process first if so wished. Throws SetupError with the place of the
/// library's name.
LoadedComponent load_component(const ComponentProfile& profile,
                               const std::vector<std::filesystem::path>& dirs,
                               const std::optional<plugin::ProbeOptions>& probe);

} // namespace tandem::engine
