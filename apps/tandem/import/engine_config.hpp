// SPDX-License-Identifier: Apache-2.0
// An installation of the OPRoS engine: its system.xml and the applications that it deploys.
#pragma once

#include "apps/tandem/import/report.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

struct EngineConfig {
    std::filesystem::path file;       ///< system.xml; empty if there is none
    std::string node_id;              ///< of this engine; "" if the file does not say
    std::filesystem::path deploy_dir; ///< where applications are, absolute
};

/// Reads system.xml in the folder, in config/ or in conf/, and tells what of it differs here. Throws engine::SetupError, a
/// line with file and line.
EngineConfig read_engine_config(const std::filesystem::path& engine_dir, ImportReport& report);

/// The application profile of that name, file or, if it is empty, the only one. Throws std::runtime_error that lists those
/// that there are.
std::filesystem::path find_application(const EngineConfig& config, const std::string& name);

} // namespace tandem::command
