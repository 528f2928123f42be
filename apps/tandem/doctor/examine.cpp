// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/checks.hpp"

namespace tandem::doctor {

std::vector<Finding> examine(const Machine& machine) {
    constexpr Finding (*checks[])(const Machine&) = {
        check_shm_mount,           check_shm_space,    check_huge_pages,     check_remove_ipc,
        check_locked_limit,        check_locking,      check_realtime_limit, check_fifo,
        check_realtime_throttling, check_open_files,   check_inotify,        check_cores,
        check_isolation,           check_nohz_full,    check_governor,       check_dma_latency,
        check_preemption,          check_clock_source, check_timer_slack,    check_hypervisor};
    std::vector<Finding> findings;
    for (const auto check : checks) findings.push_back(check(machine));
    return findings;
}

} // namespace tandem::doctor
