// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/replay/commands.hpp"
#include "apps/tandem/replay/recording.hpp"

#include <map>
#include <string>

namespace tandem::command {

/// Which side of which link a replay takes, by the link's recorded name.
using Replacement = std::map<std::string, shm::Side>;

/// By `in_place_of`, or who is absent now. Throws std::runtime_error in one line that says what to do.
Replacement find_replacement(const Recording& recording, const ReplayOptions& options);

/// The name of that link now.
std::string present_name(const std::string& recorded, const ReplayOptions& options);

} // namespace tandem::command
