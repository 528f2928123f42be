// SPDX-License-Identifier: Apache-2.0
// Reads an installation of the OPRoS engine: system.xml and the deployed applications.
#pragma once

#include "apps/tandem/import/report.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tandem::command {

struct EngineConfig {
    std::filesystem::path file;                     ///< system.xml; empty if it is missing
    std::string node_id;                            ///< of this engine; "" if the file does not contain it
    std::filesystem::path deploy_dir;               ///< folder of the applications, absolute
    std::map<std::string, std::string> addresses{}; ///< of the nodes in <node_map>, by id
};

/// Reads system.xml in the folder, in config/ or in conf/, and reports its differences. Throws engine::SetupError with
/// file and line.
EngineConfig read_engine_config(const std::filesystem::path& engine_dir, ImportReport& report);

/// Returns the application profile with this name or file; the only profile if `name` is empty. Throws
/// std::runtime_error with a list of the existing profiles.
std::filesystem::path find_application(const EngineConfig& config, const std::string& name);

} // namespace tandem::command
