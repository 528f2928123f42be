// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/checks.hpp"

namespace tandem::doctor {

// In the order of checks.hpp, which is the order of the output: from checks of requirements to checks of
// speed.

std::vector<CheckResult> run_checks(const Machine& machine) {
    constexpr CheckResult (*checks[])(const Machine&) = {check_shm_mount,
                                                         check_shm_space,
                                                         check_huge_pages,
                                                         check_remove_ipc,
                                                         check_memlock_limit,
                                                         check_memory_locking,
                                                         check_rtprio_limit,
                                                         check_sched_fifo,
                                                         check_realtime_throttling,
                                                         check_open_files,
                                                         check_inotify,
                                                         check_core_count,
                                                         check_isolated_cores,
                                                         check_nohz_full,
                                                         check_governor,
                                                         check_dma_latency,
                                                         check_preemption,
                                                         check_clock_source,
                                                         check_clock_synchronization,
                                                         check_timer_slack,
                                                         check_hypervisor};
    std::vector<CheckResult> results;
    for (const auto check : checks) results.push_back(check(machine));
    return results;
}

} // namespace tandem::doctor
