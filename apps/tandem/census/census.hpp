// SPDX-License-Identifier: Apache-2.0
// `tandem opros census` and `tandem rtm census`.
#pragma once

#include "apps/tandem/census/candidate.hpp"
#include "apps/tandem/census/trial.hpp"

#include <filesystem>
#include <vector>

namespace tandem::command {

struct CensusOptions {
    std::vector<std::filesystem::path> folders;
    TrialLimits limits;
    bool json = false;
};

/// Tries all components below the folders and prints a line for each as soon as it has been tried. Returns 0 if all run
/// and 2 if one does not. Throws std::runtime_error if there is no component or if a signal ends it.
int census(const CensusModel& model, const CensusOptions& options);

} // namespace tandem::command
