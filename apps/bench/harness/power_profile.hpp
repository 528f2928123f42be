// SPDX-License-Identifier: Apache-2.0
// Brings the machine into a case's regime, and back at the end of the scope.
#pragma once
#include "apps/bench/harness/case.hpp"
#include "host/process/child_process.hpp"

#include <sys/types.h>

namespace tandem::bench {

struct Cores {
    int a = 0, b = 1;
};

class RegimeHold {
  public:
    RegimeHold(Regime regime, const Cores& cores);
    ~RegimeHold();
    RegimeHold(const RegimeHold&) = delete;
    RegimeHold& operator=(const RegimeHold&) = delete;

  private:
    int latency_fd_ = -1;
    std::vector<process::ChildProcess> burners_; // one per core, that does nothing but compute
};

/// Why a case cannot be measured on this machine by this user; empty if it can.
std::string unmet_requirement(const Case& bench_case, const Cores& cores);

void pin_to(int core);   ///< [calling thread]
void pin_to_all_cores(); ///< [calling thread] Any core.
std::vector<int> allowed_cores();

/// Forks a process that dies with this one. 0 in the child.
pid_t fork_child();

} // namespace tandem::bench
