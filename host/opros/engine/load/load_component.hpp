// SPDX-License-Identifier: Apache-2.0
// From a component profile to a component: finds the library, checks and loads it, calls its factory, and sets
// the component's properties. [main-thread] all of it: libraries run code of their own while they are loaded.
#pragma once

#include "host/opros/engine/profile/component_profile.hpp"
#include "host/plugin/library.hpp"
#include "host/plugin/library_contents.hpp"
#include "host/plugin/parallel_probes.hpp"

#include <Component.h>

#include <memory>

namespace tandem::engine {

struct LoadedComponent {
    std::shared_ptr<plugin::Library> library;
    std::shared_ptr<Component> component; ///< keeps the library loaded, and is released by its own function
};

/// What the library's symbols and notes say, read without loading it. Throws plugin::Error unless it is an OPRoS
/// component for this processor, built against headers with our ABI number.
plugin::LibraryContents require_opros_component(const std::filesystem::path& library);

/// Loads the library and creates one component with getComponent(). Throws plugin::Error: the library cannot
/// be loaded; SetupError: getComponent() has returned NULL or thrown.
LoadedComponent instantiate_component(const std::filesystem::path& library);

/// The library that the profile names, beside the profile or in one of the folders, under any of the names that
/// plugin::library_file_names() lists. Throws SetupError at the line of <library_name>.
std::filesystem::path find_component_library(const ComponentProfile& profile,
                                             const std::vector<std::filesystem::path>& plugin_dirs);

/// Properties by which a component learns where its profile lies: the folder `res/` beside the profile, which
/// GetResourcePath() returns, and the profile's own folder.
constexpr const char* folder_property_names[] = {"_opros_xx_internal_xx_Component_Path",
                                                 "opros.component.dir"};

/// What is wrong with the properties that the component will have, as far as the profile and the files tell: values that
/// do not fit their types, and device libraries that are not there, with the nearest one that is. A line each.
std::vector<std::string> check_properties(const ComponentProfile& profile, const Properties& overrides,
                                          const std::vector<std::filesystem::path>& plugin_dirs);

/// Sets the folder properties, those of the profile, and `overrides`, in this order. A property that names a
/// device library (ApiName, DllName and the like) gets the file's path, if there is one: it is searched for as
/// the component's own library is. Throws SetupError: the device library was built against other headers.
void set_component_properties(Component& component, const ComponentProfile& profile,
                              const Properties& overrides,
                              const std::vector<std::filesystem::path>& plugin_dirs);

/// Begins to try the libraries of these components in child processes. Whatever is wrong with one is reported when it is
/// loaded.
void begin_probes(plugin::ParallelProbes& probes, const std::vector<ComponentProfile>& profiles,
                  const std::vector<std::filesystem::path>& plugin_dirs);

/// Finds and checks the library, tries it in a child process unless `probes` is NULL, loads it and creates the
/// component. Throws SetupError at the line of <library_name>, whatever fails.
LoadedComponent load_component(const ComponentProfile& profile,
                               const std::vector<std::filesystem::path>& plugin_dirs,
                               plugin::ParallelProbes* probes);

} // namespace tandem::engine
