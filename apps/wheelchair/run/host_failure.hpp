// SPDX-License-Identifier: Apache-2.0
// A host that died in mid-run: what is known about it, and what the traces say about its consequences.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

struct HostFailure {
    std::string host;
    pid_t pid = 0;
    std::string exit_status;   // "was killed by signal 9 (Killed)"
    double at = 0.0;           // CLOCK_MONOTONIC [s] when it was noticed
    double run_time = 0.0;     // scenario seconds
    double restarted_at = 0.0; // of the restarted host, 0: not restarted
    bool had_hw = false;       // HWComp was in it

    std::optional<double> motors_off_after_ms; // both motor voltages at 0, after the last reference
    std::optional<double>
        data_back_after_ms; // next reference at ControlComp, after restarted_at, else after `at`

    /// Looks in the traces for what is not known yet. True when something was found.
    bool update(const std::vector<HWRecord>& hw, const std::vector<ControlRecord>& control);
};

/// Milliseconds from the last reference that ControlComp received before `died_at` to the first tick in which
/// HWComp applied 0 V to both motors; nothing when it has not (yet).
std::optional<double> motors_off_after_ms(double died_at, const std::vector<HWRecord>& hw,
                                          const std::vector<ControlRecord>& control);

} // namespace tandem::wheelchair
