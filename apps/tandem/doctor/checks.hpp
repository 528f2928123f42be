// SPDX-License-Identifier: Apache-2.0
// One function for each thing that is checked.
#pragma once
#include "apps/tandem/doctor/finding.hpp"
#include "apps/tandem/doctor/machine.hpp"

#include <vector>

namespace tandem::doctor {

// shm_checks.cpp: where segments live
Finding check_shm_mount(const Machine& machine);
Finding check_shm_space(const Machine& machine);
Finding check_huge_pages(const Machine& machine);
Finding check_remove_ipc(const Machine& machine); // remove_ipc.cpp

// permission_checks.cpp: limits, and what they permit
Finding check_locked_limit(const Machine& machine);
Finding check_locking(const Machine& machine);
Finding check_realtime_limit(const Machine& machine);
Finding check_fifo(const Machine& machine);
Finding check_realtime_throttling(const Machine& machine);
Finding check_open_files(const Machine& machine);
Finding check_inotify(const Machine& machine);

// timing_checks.cpp: what lies between a wake-up and its thread
Finding check_cores(const Machine& machine);
Finding check_isolation(const Machine& machine);
Finding check_nohz_full(const Machine& machine);
Finding check_governor(const Machine& machine);
Finding check_dma_latency(const Machine& machine);
Finding check_preemption(const Machine& machine);
Finding check_clock_source(const Machine& machine);
Finding check_timer_slack(const Machine& machine);
Finding check_hypervisor(const Machine& machine);

std::vector<Finding> examine(const Machine& machine); ///< all of them, in this order

} // namespace tandem::doctor
