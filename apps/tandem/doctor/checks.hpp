// SPDX-License-Identifier: Apache-2.0
// One function for each thing that is checked.
#pragma once
#include "apps/tandem/doctor/check_result.hpp"
#include "apps/tandem/doctor/machine.hpp"

#include <vector>

namespace tandem::doctor {

// shm_checks.cpp: where segments live
CheckResult check_shm_mount(const Machine& machine);
CheckResult check_shm_space(const Machine& machine);
CheckResult check_huge_pages(const Machine& machine);
CheckResult check_remove_ipc(const Machine& machine); // remove_ipc.cpp

// permission_checks.cpp: limits, and what they permit
CheckResult check_memlock_limit(const Machine& machine);
CheckResult check_memory_locking(const Machine& machine);
CheckResult check_rtprio_limit(const Machine& machine);
CheckResult check_sched_fifo(const Machine& machine);
CheckResult check_realtime_throttling(const Machine& machine);
CheckResult check_open_files(const Machine& machine);
CheckResult check_inotify(const Machine& machine);

// timing_checks.cpp: what lies between a wake-up and its thread
CheckResult check_core_count(const Machine& machine);
CheckResult check_isolated_cores(const Machine& machine);
CheckResult check_nohz_full(const Machine& machine);
CheckResult check_governor(const Machine& machine);
CheckResult check_dma_latency(const Machine& machine);
CheckResult check_preemption(const Machine& machine);
CheckResult check_clock_source(const Machine& machine);
CheckResult check_timer_slack(const Machine& machine);
CheckResult check_hypervisor(const Machine& machine);

std::vector<CheckResult> run_checks(const Machine& machine); ///< all of them, in this order

} // namespace tandem::doctor
