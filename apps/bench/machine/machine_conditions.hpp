// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/harness/case.hpp"
#include "apps/bench/machine/cores.hpp"
#include "host/process/child_process.hpp"

#include <string>
#include <vector>

namespace tandem::bench {

/// [driver] Puts the machine into the power profile and the load that a case requires. The destructor undoes
/// this. The constructor throws std::system_error if the kernel refuses.
class MachineConditions {
  public:
    MachineConditions(const Case& bench_case, const Cores& cores);

  private:
    process::FileDescriptor latency_file_;              // /dev/cpu_dma_latency, if held
    std::vector<process::ChildProcess> load_processes_; // killed with this object
};

/// Returns why this user cannot measure a case on this machine, with the remedy; empty if it can be measured.
std::string unmet_requirement(const Case& bench_case, const Cores& cores);

} // namespace tandem::bench
