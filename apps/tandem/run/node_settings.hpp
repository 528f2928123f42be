// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/node/node_part.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// Returns the settings (KEY:VALUE) with which the rtm_host of a node makes the connections to other nodes. They are
/// added to those of `rtc_conf`, which may be empty. Returns nothing if there are no such connections. Throws
/// RTC::ManagerError if the file cannot be read.
std::vector<std::string> node_settings(const engine::NodePart& part, const std::filesystem::path& rtc_conf);

} // namespace tandem::command
