// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/replay/commands.hpp"
#include "apps/tandem/replay/recording.hpp"

#include <map>
#include <string>

namespace tandem::command {

/// The side that a replay takes in each link, by the link's recorded name.
using Replacement = std::map<std::string, shm::Side>;

/// Determines the sides from `in_place_of`, or from the absent hosts. Throws std::runtime_error with one
/// line that names the remedy.
Replacement find_replacement(const Recording& recording, const ReplayOptions& options);

/// Returns the link's current name.
std::string present_name(const std::string& recorded, const ReplayOptions& options);

} // namespace tandem::command
