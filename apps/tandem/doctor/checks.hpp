// SPDX-License-Identifier: Apache-2.0
// The checks of `tandem doctor`, one function each. A check reads only the given Machine, does not throw on
// unexpected content, and has the same name on every machine. To add a check, declare it here, define it in
// the file of its group and list it in run_checks.cpp.
#pragma once
#include "apps/tandem/doctor/check_result.hpp"
#include "apps/tandem/doctor/machine.hpp"

#include <string>
#include <vector>

namespace tandem::doctor {

// shm_checks.cpp: the file system that holds the segments
CheckResult check_shm_mount(const Machine& machine);
CheckResult check_shm_space(const Machine& machine);
CheckResult check_huge_pages(const Machine& machine);
CheckResult check_remove_ipc(const Machine& machine); // remove_ipc.cpp

// permission_checks.cpp: resource limits and permissions of this user
CheckResult check_memlock_limit(const Machine& machine);
CheckResult check_memory_locking(const Machine& machine);
CheckResult check_rtprio_limit(const Machine& machine);
CheckResult check_sched_fifo(const Machine& machine);
CheckResult check_realtime_throttling(const Machine& machine);
CheckResult check_open_files(const Machine& machine);
CheckResult check_inotify(const Machine& machine);
/// Returns advice for a user who lacks a permission: to join the group of the Debian packages, which has all
/// permissions, if they are installed; otherwise `by_hand`.
std::string remedy_for_user(const Machine& machine, const std::string& by_hand);

// timing_checks.cpp: wake-up latency of threads and accuracy of clocks
CheckResult check_core_count(const Machine& machine);
CheckResult check_isolated_cores(const Machine& machine);
CheckResult check_nohz_full(const Machine& machine);
CheckResult check_governor(const Machine& machine);
CheckResult check_dma_latency(const Machine& machine);
CheckResult check_preemption(const Machine& machine);
CheckResult check_clock_source(const Machine& machine);
CheckResult check_clock_synchronization(const Machine& machine); // clock_synchronization.cpp
CheckResult check_timer_slack(const Machine& machine);
CheckResult check_hypervisor(const Machine& machine);

std::vector<CheckResult> run_checks(const Machine& machine); ///< Runs all checks above, in this order.

} // namespace tandem::doctor
