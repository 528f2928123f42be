// SPDX-License-Identifier: Apache-2.0
// Turns a component profile into a component: finds, checks and loads the library, calls its factory, and sets the
// component's properties. All functions [main-thread], because libraries run code while they are loaded.
#pragma once

#include "host/opros/engine/profile/application_profile.hpp"
#include "host/plugin/library.hpp"
#include "host/plugin/library_contents.hpp"
#include "host/plugin/parallel_probes.hpp"

#include <Component.h>

#include <memory>

namespace tandem::engine {

struct LoadedComponent {
    std::shared_ptr<plugin::Library> library;
    std::shared_ptr<Component> component; ///< keeps the library loaded, which also releases it
};

/// Reads the library's symbols and notes without loading it. Throws plugin::Error unless the library is an OPRoS
/// component for this processor, built against headers with this process's ABI number.
plugin::LibraryContents require_opros_component(const std::filesystem::path& library);

/// Loads the library and creates one component with getComponent(). Throws plugin::Error if the library cannot be
/// loaded, and SetupError if getComponent() returns NULL or throws.
LoadedComponent instantiate_component(const std::filesystem::path& library);

/// Finds the library that the profile names, beside the profile or in one of the folders, under any of the names that
/// plugin::library_file_names() lists. Throws SetupError at the line of <library_name>.
std::filesystem::path find_component_library(const ComponentProfile& profile,
                                             const std::vector<std::filesystem::path>& plugin_dirs);

/// Properties that tell a component where its profile is: the folder `res/` beside the profile, which GetResourcePath()
/// returns, and the folder of the profile.
constexpr const char* folder_property_names[] = {"_opros_xx_internal_xx_Component_Path",
                                                 "opros.component.dir"};

/// Returns the errors in the profile and in the component's properties that the profiles and the files reveal, one line
/// each: elements without effect, values that do not fit their types, and missing device libraries, with the most similar
/// library that exists. `entry`: the component in the application.
std::vector<std::string> check_properties(const ComponentProfile& profile, const Subcomponent& entry,
                                          const std::vector<std::filesystem::path>& plugin_dirs);

/// Sets the folder properties, the profile's properties, and `overrides`, in this order. A property that names a device
/// library (ApiName, DllName and the like) gets the file's path, if the file exists. The search is the same as for the
/// component's own library. Throws SetupError if the device library was built against other headers.
void set_component_properties(Component& component, const ComponentProfile& profile,
                              const Properties& overrides,
                              const std::vector<std::filesystem::path>& plugin_dirs);

/// Starts to try the libraries of these components in child processes. Errors are reported when the library is loaded.
void begin_probes(plugin::ParallelProbes& probes, const std::vector<ComponentProfile>& profiles,
                  const std::vector<std::filesystem::path>& plugin_dirs);

/// Finds and checks the library, tries it in a child process unless `probes` is NULL, loads it and creates the
/// component. Throws SetupError at the line of <library_name> for every failure.
LoadedComponent load_component(const ComponentProfile& profile,
                               const std::vector<std::filesystem::path>& plugin_dirs,
                               plugin::ParallelProbes* probes);

} // namespace tandem::engine
