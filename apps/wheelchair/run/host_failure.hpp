// SPDX-License-Identifier: Apache-2.0
// A host that ended during a run, and the consequences that the traces show.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// Times are seconds of CLOCK_MONOTONIC unless a name says otherwise.
struct HostFailure {
    std::string host;
    pid_t pid = 0;
    std::string exit_status;   // "was killed by signal 9 (Killed)"
    double at = 0.0;           // when the end was detected
    double run_time = 0.0;     // the same in scenario seconds
    double restarted_at = 0.0; // when the restarted host was ready; 0: not restarted
    bool had_hw = false;       // HWComp ran in this host

    // From the last reference until both motor voltages are 0; unknown if HWComp ended with the host.
    std::optional<double> motors_off_after_ms;
    // From restarted_at (or `at` without a restart) to the next reference that ControlComp received.
    std::optional<double> data_back_after_ms;

    /// Searches the traces for durations that are still unknown. Returns true if it found one.
    bool update(const std::vector<HWRecord>& hw, const std::vector<ControlRecord>& control);
};

/// Returns the time in ms from the last reference that ControlComp received before `failed_at` to the first tick in
/// which HWComp applied 0 V to both motors; nullopt if the traces do not show it (yet).
std::optional<double> motors_off_after_ms(double failed_at, const std::vector<HWRecord>& hw,
                                          const std::vector<ControlRecord>& control);

} // namespace tandem::wheelchair
