// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/hosts/supervisor.hpp"
#include "apps/tandem/census/candidate.hpp"

#include <cstdint>
#include <string>

namespace tandem::command {

/// How far a component came.
struct TrialResult {
    bool built = false, loads = false, runs = false, interrupted = false;
    std::uint64_t cycles = 0;
    std::string error; ///< the first error with its remedy, in one line; "" if the component runs
};

struct TrialLimits {
    double build_s = 300; ///< separate limits for configuring and compiling
    double run_s = 3;     ///< time for which the component runs
};

/// Builds, loads and runs a component in child processes. Writes only below `folder`.
TrialResult try_component(const CensusModel& model, const Candidate& candidate,
                          const std::filesystem::path& folder, const TrialLimits& limits,
                          hosts::Supervisor& supervisor);

} // namespace tandem::command
