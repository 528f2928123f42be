// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/census/candidate.hpp"
#include "apps/tandem/commands.hpp"

namespace tandem::command {

/// Adds the sub-command `census DIR...`. `what`: how its help text calls what it finds below DIR.
void add_census_command(CLI::App& parent, const CensusModel& model, const char* what, Action& selected);

} // namespace tandem::command
