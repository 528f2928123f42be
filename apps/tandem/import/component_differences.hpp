// SPDX-License-Identifier: Apache-2.0
// Reports how opros_host will run an application differently from the OPRoS engine, as far as the profiles show.
#pragma once

#include "apps/tandem/import/engine_config.hpp"

#include "host/opros/engine/profile/application_profile.hpp"

#include <map>

namespace tandem::command {

/// Reports differences in the application profile itself: nodes, properties, connections.
void tell_application_differences(const engine::ApplicationProfile& application, const EngineConfig& config,
                                  ImportReport& report);

struct ComponentPlaces {
    std::filesystem::path engine_dir;
    const engine::ApplicationProfile& application; ///< in the installation
    std::map<std::filesystem::path, std::filesystem::path>
        folders; ///< new path to original path of each copied folder
};

/// Copies the component's library beside its profile if opros_host can load it; otherwise adds the task to build it.
/// Reports differences in the profile. Throws engine::SetupError if the profile is not well-formed.
void import_component(const engine::Subcomponent& component, const ComponentPlaces& places,
                      ImportReport& report);

} // namespace tandem::command
