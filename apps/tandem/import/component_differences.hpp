// SPDX-License-Identifier: Apache-2.0
// What differs between the OPRoS engine and opros_host for one application, as far as its profiles tell.
#pragma once

#include "apps/tandem/import/engine_config.hpp"

#include "host/opros/engine/profile/application_profile.hpp"

#include <map>

namespace tandem::command {

/// Tells what of the application profile itself differs: nodes, properties, connections.
void tell_application_differences(const engine::ApplicationProfile& application, const EngineConfig& config,
                                  ImportReport& report);

struct ComponentPlaces {
    std::filesystem::path engine_dir;
    const engine::ApplicationProfile& application; ///< of the installation
    std::map<std::filesystem::path, std::filesystem::path>
        folders; ///< copied folders: where they are, where they were
};

/// Copies the component's library beside its profile if opros_host can load it; otherwise building it is a task. Tells
/// what of the profile differs. Throws engine::SetupError for a profile that is not well-formed.
void import_component(const engine::Subcomponent& component, const ComponentPlaces& places,
                      ImportReport& report);

} // namespace tandem::command
