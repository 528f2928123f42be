// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/import/engine_config.hpp"
#include "apps/tandem/import/report.hpp"
#include "host/opros/engine/profile/application_profile.hpp"

#include <pugixml.hpp>

namespace tandem::command {

/// The nodes of an imported application. The engine runs the components of its node, and those without a node.
class ImportNodes {
  public:
    /// Both arguments must outlive this object.
    ImportNodes(const engine::ApplicationProfile& application, const EngineConfig& config)
        : application_(application), config_(config) {}

    /// Returns whether another node runs the component.
    bool is_elsewhere(const engine::Subcomponent& component) const {
        return !config_.node_id.empty() && !component.node.empty() && component.node != config_.node_id;
    }
    /// Returns whether another node runs a component of the application.
    bool has_elsewhere() const;

    /// Adds the engine's node and the addresses of the others to an application profile.
    void write(pugi::xml_node root) const;
    /// Reports what differs, and what the profile lacks. `written`: the application in the new folder.
    void report(const engine::ApplicationProfile& written, ImportReport& report) const;

  private:
    const engine::ApplicationProfile& application_;
    const EngineConfig& config_;
};

} // namespace tandem::command
